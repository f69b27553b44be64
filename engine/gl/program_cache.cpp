// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/program.hpp"

namespace halfshadow::gl {

ProgramCache::ProgramCache(Context& context, ShaderSourceProvider provider,
                           std::vector<device::ShaderFamily> families)
    : context_(context), provider_(std::move(provider)), families_(std::move(families)) {}

Result<ProgramCache::Sources> ProgramCache::assemble(const ProgramVariant& variant) const {
  const device::Capabilities& capabilities = context_.capabilities();
  if (!families_.empty()) {
    if (Status s = device::checkVariant(families_, variant, capabilities); !s) return s.error();
  }
  Result<std::string> vertex = assembleShader(provider_, variant.vertexFile, variant.defines, capabilities);
  if (!vertex) return vertex.error();
  Result<std::string> fragment =
      assembleShader(provider_, variant.fragmentFile, variant.defines, capabilities);
  if (!fragment) return fragment.error();
  return Sources{std::move(*vertex), std::move(*fragment)};
}

Result<Program*> ProgramCache::get(const ProgramVariant& variant) {
  if (const auto found = programs_.find(variant); found != programs_.end()) {
    found->second.frame = frame_;
    return found->second.program.get();
  }
  Result<Sources> sources = assemble(variant);
  if (!sources) return sources.error();
  std::string label = variant.vertexFile + " + " + variant.fragmentFile;
  for (const std::string& define : variant.defines) label += " " + define;
  Result<Program> program =
      Program::link(context_, sources->vertex, sources->fragment, samplerNamesOf(sources->fragment), label);
  if (!program) return program.error();
  Cached cached{std::make_unique<Program>(std::move(*program)), frame_};
  return programs_.emplace(variant, std::move(cached)).first->second.program.get();
}

void ProgramCache::trim() {
  std::erase_if(programs_, [&](const auto& entry) { return entry.second.frame != frame_; });
}

void ProgramCache::clear() {
  programs_.clear();
}

}  // namespace halfshadow::gl
