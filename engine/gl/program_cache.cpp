// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/program.hpp"

namespace halfshadow::gl {

ProgramCache::ProgramCache(Context& context, ShaderSourceProvider provider)
    : context_(context), provider_(std::move(provider)) {}

Result<Program*> ProgramCache::get(const ProgramVariant& variant) {
  if (const auto found = programs_.find(variant); found != programs_.end()) return found->second.get();
  const Capabilities& capabilities = context_.capabilities();
  Result<std::string> vertex = assembleShader(provider_, variant.vertexFile, variant.defines, capabilities);
  if (!vertex) return vertex.error();
  Result<std::string> fragment =
      assembleShader(provider_, variant.fragmentFile, variant.defines, capabilities);
  if (!fragment) return fragment.error();

  std::string label = variant.vertexFile + " + " + variant.fragmentFile;
  for (const std::string& define : variant.defines) label += " " + define;
  Result<Program> program = Program::link(context_, *vertex, *fragment, samplerNamesOf(*fragment), label);
  if (!program) return program.error();
  const auto place = programs_.emplace(variant, std::make_unique<Program>(std::move(*program))).first;
  return place->second.get();
}

void ProgramCache::clear() {
  programs_.clear();
}

}  // namespace halfshadow::gl
