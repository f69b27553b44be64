// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Ray-traced visibility that grows in the background while nothing moves.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "viewer/view.hpp"

namespace halfshadow::viewer {

/// Visibility of the first light, row 0 on top. Never changed once it is handed out.
struct TruthImage {
  int width = 0, height = 0;
  int samples = 0;  ///< light points per pixel so far
  std::vector<float> visibility;
  std::vector<std::uint8_t> kind;  ///< reference::ReceiverKind
  double noiseAtMost = 0.0;        ///< RMSE that so many independent samples would have; strata have less
};

/// Averages independently jittered images of more and more samples. One thread, which itself traces with all
/// but one of the processor's: the picture on the screen goes first.
class TruthWorker {
 public:
  /// `samples` per pixel at which it is done. `wake` is called from the worker's thread when there is news.
  TruthWorker(int samples, std::function<void()> wake);
  ~TruthWorker();
  TruthWorker(const TruthWorker&) = delete;
  TruthWorker& operator=(const TruthWorker&) = delete;

  /// What is wanted now. The same question as before goes on; another throws away what there is.
  void ask(const View& view);
  void forget();

  /// Of the question asked last, or null: nothing yet.
  std::shared_ptr<const TruthImage> image() const;
  struct State {
    double share = 0.0;  ///< of all samples
    bool done = false;   ///< or failed, or nothing asked
    std::string error;
  };
  State state() const;

 private:
  void run();
  void trace(const View& view, std::uint64_t question);
  bool isStale(std::uint64_t question) const { return question_.load() != question; }
  void fail(std::uint64_t question, const std::string& message);

  const int samples_;
  const std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<View> wanted_;  ///< not begun yet
  std::optional<View> asked_;
  std::shared_ptr<const TruthImage> image_;
  State state_{.done = true};
  bool ends_ = false;
  std::atomic<std::uint64_t> question_{0};
  std::thread thread_;
};

}  // namespace halfshadow::viewer
