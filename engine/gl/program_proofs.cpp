// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/program_proofs.hpp"

#include <algorithm>
#include <charconv>

#include "base/keys.hpp"
#include "gl/proof_bench.hpp"

namespace halfshadow::gl {
namespace {

constexpr std::string_view kFirstLine = "halfshadow program proofs 1";

bool readsDepth(const device::TextureDesc& desc) {
  using device::TextureFormat;
  return desc.format == TextureFormat::depth16 || desc.format == TextureFormat::depth24 ||
         desc.format == TextureFormat::depth24Stencil8;
}

/// Cuts the first line off.
std::string_view takeLine(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  return line;
}

std::string driverLine(const device::DriverIdentity& driver) {
  std::string line = driver.vendor + " | " + driver.renderer + " | " + driver.version;
  std::ranges::replace(line, '\n', ' ');
  return line;
}

std::string hexOf(ProofKey key) {
  char digits[16];
  const auto end = std::to_chars(digits, digits + sizeof digits, key, 16).ptr;
  return {digits, end};
}

}  // namespace

ProofKey proofKeyOf(const ProgramUse& use) {
  const DrawState& state = use.state;
  std::uint64_t fixed = state.blend.enabled ? 1 : 0;
  const auto add = [&](std::uint64_t value, int bits) { fixed = (fixed << bits) | value; };
  if (state.blend.enabled) {
    add(static_cast<std::uint64_t>(state.blend.equation), 3);
    add(static_cast<std::uint64_t>(state.blend.source), 4);
    add(static_cast<std::uint64_t>(state.blend.destination), 4);
  }
  for (const bool written : state.colorMask) add(written, 1);
  add(state.depth.test != Compare::always, 1);
  add(state.depth.write, 1);
  ProofKey key = combineKeys(use.program->sourceKey(), fixed);
  for (const ProgramUse::Sampled& sampled : use.textures) {
    if (sampled.unit >= 0 && readsDepth(sampled.desc))
      key = combineKeys(key, static_cast<std::uint64_t>(sampled.unit));
  }
  return key;
}

void ProgramProofs::ask(ProofKey key, const ProgramUse& use) {
  if (known_.contains(key) || std::ranges::find(asked_, key, &Asked::key) != asked_.end()) return;
  asked_.push_back({key, use});
}

Proof ProgramProofs::of(ProofKey key) const {
  const auto found = known_.find(key);
  return found == known_.end() ? Proof::unknown : found->second;
}

Status ProgramProofs::run(Encoder& encoder) {
  std::vector<Asked> asked;
  std::swap(asked, asked_);
  for (const Asked& each : asked) known_[each.key] = Proof::unproven;
  constexpr std::size_t kBatch = ProofBench::kColumns - 1;
  for (std::size_t first = 0; first < asked.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, asked.size() - first);
    std::vector<const ProgramUse*> uses;
    for (std::size_t i = 0; i < count; ++i) uses.push_back(&asked[first + i].use);
    const auto traces = ProofBench(encoder).traces(uses);
    if (!traces) return traces.error();
    for (std::size_t i = 0; i < count; ++i)
      known_[asked[first + i].key] = (*traces)[i] ? Proof::draws : Proof::dropped;
  }
  return {};
}

std::string ProgramProofs::text(const device::DriverIdentity& driver) const {
  std::string text = std::string(kFirstLine) + "\n" + driverLine(driver) + "\n";
  for (const auto& [key, proof] : known_) {
    if (proof == Proof::draws) text += hexOf(key) + " draws\n";
    if (proof == Proof::dropped) text += hexOf(key) + " dropped\n";
  }
  return text;
}

bool ProgramProofs::restore(std::string_view text, const device::DriverIdentity& driver) {
  if (takeLine(text) != kFirstLine || takeLine(text) != driverLine(driver)) return false;
  std::map<ProofKey, Proof> read;
  while (!text.empty()) {
    const std::string_view line = takeLine(text);
    ProofKey key = 0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), key, 16);
    const std::string_view answer = line.substr(static_cast<std::size_t>(end - line.data()));
    if (error != std::errc() || (answer != " draws" && answer != " dropped")) return false;
    read[key] = answer == " draws" ? Proof::draws : Proof::dropped;
  }
  known_.merge(read);
  return true;
}

}  // namespace halfshadow::gl
