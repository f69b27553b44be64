// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <array>
#include <set>
#include <sstream>

#include "framegraph/plan.hpp"

namespace halfshadow::framegraph {
namespace {

constexpr std::size_t kColumnCount = 6;
using Row = std::array<std::string, kColumnCount>;

std::string_view stageName(PassStage stage) {
  switch (stage) {
    case PassStage::light:
      return "light";
    case PassStage::mask:
      return "mask";
    case PassStage::receiverPrepass:
      return "receiver-prepass";
    case PassStage::scene:
      return "scene";
    case PassStage::resolve:
      return "resolve";
  }
  return "?";
}

std::string_view formatName(const ResourceDesc& desc) {
  if (desc.lifetime == Lifetime::imported) return "host";
  switch (desc.format) {
    case Format::rgba8:
      return "rgba8";
    case Format::depth16:
      return "depth16";
    case Format::depth24:
      return "depth24";
    case Format::stencil8:
      return "stencil8";
    case Format::depth24Stencil8:
      return "depth24-stencil8";
  }
  return "?";
}

std::string_view loadName(LoadAction load) {
  switch (load) {
    case LoadAction::clear:
      return "clear";
    case LoadAction::load:
      return "load";
    case LoadAction::dontCare:
      return "dont-care";
  }
  return "?";
}

std::string_view storeName(StoreAction store) {
  return store == StoreAction::store ? "store" : "discard";
}

std::string sizeAndFormat(const ResourceDesc& desc) {
  return std::to_string(desc.width) + "x" + std::to_string(desc.height) + " " + std::string(formatName(desc));
}

std::string readNames(const Graph& graph, const PassDesc& pass) {
  std::string names;
  for (const ResourceId read : pass.reads) {
    names += (names.empty() ? "" : ", ") + graph.resources()[read.index].name;
  }
  return names.empty() ? "-" : names;
}

// A string between double quotes of the DOT language.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}
}  // namespace

std::string targetText(const Graph& graph, const PlannedPass& planned) {
  std::string text;
  std::set<std::uint32_t> named;
  for (const PlannedAttachment& attachment : planned.attachments) {
    const std::uint32_t index = attachment.resource.index;
    if (named.insert(index).second) text += (text.empty() ? "" : "+") + graph.resources()[index].name;
  }
  const ResourceDesc& first = graph.resources()[planned.attachments.front().resource.index];
  return text + " " + std::to_string(first.width) + "x" + std::to_string(first.height);
}

std::string Plan::text(const Graph& graph) const {
  std::vector<Row> rows{{"pass", "stage", "target", "load->store", "bytes in/out", "reads"}};
  for (const PlannedPass& planned : passes) {
    const PassDesc& pass = graph.passes()[planned.pass];
    for (const PlannedAttachment& attachment : planned.attachments) {
      const bool first = &attachment == &planned.attachments.front();
      const ResourceDesc& desc = graph.resources()[attachment.resource.index];
      rows.push_back(
          {first ? pass.name : "", first ? std::string(stageName(pass.stage)) : "",
           desc.name + " " + sizeAndFormat(desc),
           std::string(loadName(attachment.load)) + "->" + std::string(storeName(attachment.store)),
           std::to_string(attachment.bytesLoaded) + "/" + std::to_string(attachment.bytesStored),
           first ? readNames(graph, pass) : ""});
    }
  }
  std::array<std::size_t, kColumnCount> widths{};
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < kColumnCount; ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::ostringstream out;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < kColumnCount; ++i)
      line += row[i] + std::string(widths[i] - row[i].size() + 2, ' ');
    line.erase(line.find_last_not_of(' ') + 1);
    out << line << '\n';
  }
  for (const PlannedPass& planned : passes) {
    const std::string& name = graph.passes()[planned.pass].name;
    if (planned.generatesMipmaps) out << "mipmaps after " << name << '\n';
    if (!planned.rebindReason.empty()) out << name << " binds again: " << planned.rebindReason << '\n';
  }
  out << "total: " << passes.size() << " passes, " << bytesLoaded << " bytes loaded, " << bytesStored
      << " bytes stored\n";
  for (const Graph::Skipped& skip : skipped) out << "skipped " << skip.what << ": " << skip.why << '\n';
  return out.str();
}

std::string Plan::graphviz(const Graph& graph) const {
  std::ostringstream out;
  out << "digraph frame {\n  rankdir=LR;\n";
  std::set<std::uint32_t> used;
  for (const PlannedPass& planned : passes) {
    for (const PlannedAttachment& attachment : planned.attachments) used.insert(attachment.resource.index);
    for (const ResourceId read : graph.passes()[planned.pass].reads) used.insert(read.index);
  }
  for (const std::uint32_t index : used) {
    const ResourceDesc& desc = graph.resources()[index];
    out << "  r" << index << " [shape=ellipse, label=" << quoted(desc.name + " " + sizeAndFormat(desc))
        << "];\n";
  }
  for (const PlannedPass& planned : passes) {
    const PassDesc& pass = graph.passes()[planned.pass];
    out << "  p" << planned.pass
        << " [shape=box, label=" << quoted(pass.name + " (" + std::string(stageName(pass.stage)) + ")")
        << "];\n";
    for (const ResourceId read : pass.reads) out << "  r" << read.index << " -> p" << planned.pass << ";\n";
    for (const PlannedAttachment& attachment : planned.attachments) {
      if (attachment.load == LoadAction::load) {
        out << "  r" << attachment.resource.index << " -> p" << planned.pass
            << " [style=dashed, label=\"load\"];\n";
      }
      out << "  p" << planned.pass << " -> r" << attachment.resource.index
          << " [label=" << quoted(std::string(storeName(attachment.store))) << "];\n";
    }
  }
  out << "}\n";
  return out.str();
}

}  // namespace halfshadow::framegraph
