// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "measure/text_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace halfshadow::measure {
namespace {
namespace fs = std::filesystem;

Error notWritable(const fs::path& path, const std::string& why) {
  return {ErrorCode::fileNotWritable, "cannot write " + path.string() + ": " + why};
}

fs::path temporaryBeside(const fs::path& path) {
  return path.parent_path() / ("." + path.filename().string() + "." + std::to_string(getpid()) + ".tmp");
}
}  // namespace

Status writeTextFile(const fs::path& path, const std::string& text) {
  const fs::path temporary = temporaryBeside(path);
  std::ofstream file(temporary, std::ios::binary);
  file << text;
  file.close();
  std::error_code failure;
  if (!file) {
    const std::string why = std::strerror(errno);
    fs::remove(temporary, failure);
    return notWritable(path, why + "; check the folder and the free space");
  }
  fs::rename(temporary, path, failure);
  if (failure) {
    const Error error = notWritable(path, failure.message());
    fs::remove(temporary, failure);
    return error;
  }
  return {};
}

Status checkWritable(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code failure;
  if (!fs::is_directory(folder, failure)) {
    return notWritable(path, "the folder " + folder.string() + " does not exist; make it first");
  }
  if (path.filename().empty() || fs::is_directory(path, failure)) {
    return notWritable(path, "it is a folder; give the name of a file");
  }
  const fs::path temporary = temporaryBeside(path);
  errno = 0;
  std::ofstream file(temporary);
  const bool opened = file.is_open();
  const std::string why = std::strerror(errno);
  file.close();
  fs::remove(temporary, failure);
  if (!opened) return notWritable(path, why + "; choose a folder that you may write to");
  return {};
}

}  // namespace halfshadow::measure
