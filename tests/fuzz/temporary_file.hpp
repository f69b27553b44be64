// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A file for readers that take paths, alone in a folder of its own.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "fuzz_target.hpp"

namespace halfshadow::fuzz {

class TemporaryFile {
 public:
  explicit TemporaryFile(const char* name) {
    std::string folder = (std::filesystem::temp_directory_path() / "halfshadow-fuzz-XXXXXX").string();
    require(mkdtemp(folder.data()) != nullptr, "no temporary folder can be made; check TMPDIR");
    folder_ = folder;
    path_ = (folder_ / name).string();
  }
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(Input content) const {
    std::ofstream stream(path_, std::ios::binary | std::ios::trunc);
    stream.write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
    require(static_cast<bool>(stream.flush()), "the temporary file cannot be written; check the free space");
  }
  const std::string& path() const { return path_; }
  std::string folder() const { return folder_.string(); }

 private:
  std::filesystem::path folder_;
  std::string path_;
};

}  // namespace halfshadow::fuzz
