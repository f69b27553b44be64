// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>

#include "gl/program.hpp"

namespace halfshadow::gl {

ProgramCache::ProgramCache(Context& context, ShaderSourceProvider provider,
                           std::vector<AllowedVariants> allowed)
    : context_(context), provider_(std::move(provider)), allowed_(std::move(allowed)) {}

Status ProgramCache::checkAllowed(const ProgramVariant& variant) const {
  if (allowed_.empty()) return {};
  const auto row = std::ranges::find_if(allowed_, [&](const AllowedVariants& candidate) {
    return candidate.vertexFile == variant.vertexFile && candidate.fragmentFile == variant.fragmentFile;
  });
  if (row == allowed_.end()) {
    return Error{ErrorCode::internal, variant.vertexFile + " + " + variant.fragmentFile +
                                          " is not in the table of shader variants; add a row"};
  }
  for (const std::string& define : variant.defines) {
    const std::string_view name = std::string_view(define).substr(0, define.find_first_of(" ("));
    if (std::ranges::find(row->defines, name) == row->defines.end()) {
      return Error{ErrorCode::internal, std::string(name) + " is not allowed with " + variant.fragmentFile +
                                            " by the table of shader variants; add it there"};
    }
  }
  return {};
}

Result<Program*> ProgramCache::get(const ProgramVariant& variant) {
  if (const auto found = programs_.find(variant); found != programs_.end()) return found->second.get();
  if (Status s = checkAllowed(variant); !s) return s.error();
  const device::Capabilities& capabilities = context_.capabilities();
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
