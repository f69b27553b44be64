// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Where messages that are not errors go. The engine never writes to a stream itself.
#pragma once

#include <functional>
#include <string_view>

namespace halfshadow {

enum class LogLevel { info, warning };

using LogSink = std::function<void(LogLevel, std::string_view)>;

/// Replaces the process-wide sink; an empty function (the default) drops messages. Not thread-safe.
void setLogSink(LogSink sink);
void logMessage(LogLevel level, std::string_view message);

}  // namespace halfshadow
