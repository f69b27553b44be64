// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <string>

#include "base/log.hpp"
#include "measure/text_file.hpp"
#include "output.hpp"
#include "viewer/app.hpp"

namespace halfshadow::viewer {
namespace {
int runViewer(int argc, char** argv) {
  int status = cli::kDone;
  auto options = parseOptions(argc, argv, status);
  if (!options) return status;
  auto app = App::create(std::move(*options));
  if (!app) return cli::fail(app.error());
  if (Status ran = (*app)->run(); !ran) return cli::fail(ran.error());
  return cli::kDone;
}
}  // namespace
}  // namespace halfshadow::viewer

int main(int argc, char** argv) {
  using namespace halfshadow;
  setLogSink([](LogLevel level, std::string_view message) {
    if (level == LogLevel::warning) cli::say("warning: " + std::string(message));
  });
  try {
    return viewer::runViewer(argc, argv);
  } catch (const std::bad_alloc&) {
    cli::say("out of memory; give a smaller window or scene");
  } catch (const std::exception& error) {
    cli::say(std::string("internal error: ") + error.what());
  }
  return cli::kFailed;
}
