// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The report's page as its readers use it: pictures, and the command lines that stand below them.
#pragma once

#include <string>
#include <vector>

#include "images/images.hpp"

namespace halfshadow::cli_tests {

/// What the page offers below one picture.
struct Offer {
  std::string inViewer, command;
  images::ByteImage visibility;  ///< the card's; empty for a shaded picture
};
std::vector<Offer> offersOf(const std::string& page);

/// Runs `halfshadow …` in `folder` through a shell, as one who copies the line. Returns the file that it
/// wrote.
std::string play(std::string command, const std::string& folder);

/// `made` is what the card shows, to half a grey level; `command` names it in failures.
void expectSameVisibility(const images::ByteImage& shown, const images::FloatImage& made,
                          const std::string& command);

/// An empty image, and a failure of the test, when it cannot be read.
images::FloatImage readImage(const std::string& file);
std::string textOf(const std::string& file);

}  // namespace halfshadow::cli_tests
