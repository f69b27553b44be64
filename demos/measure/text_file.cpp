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

Status writeThrough(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary | std::ios::app);  // not truncated: it may hold other output
  file << text;
  file.close();
  return file ? Status{} : Status(notWritable(path, std::strerror(errno)));
}
}  // namespace

bool isSpecial(const fs::path& path) {
  const std::string name = path.lexically_normal().string();
  if (name.starts_with("/dev/") || name.starts_with("/proc/")) return true;
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

Status writeTextFile(const fs::path& path, const std::string& text) {
  if (isSpecial(path)) return writeThrough(path, text);
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
  if (isSpecial(path) && fs::exists(path))
    return notWritable(path, "it is a device or pipe; give the name of a file");
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
