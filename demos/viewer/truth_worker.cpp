// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "viewer/truth_worker.hpp"

#include <algorithm>
#include <cmath>

#include "reference/reference.hpp"

namespace halfshadow::viewer {
namespace {
/// Of the first image; each further one has four times as many.
constexpr int kFirstSamples = 4;

double noiseOf(const TruthImage& image) {
  double sum = 0.0;
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < image.visibility.size(); ++i) {
    if (image.kind[i] == reference::kNoReceiver) continue;
    const double v = image.visibility[i];
    sum += v * (1.0 - v) / image.samples;
    ++pixels;
  }
  return pixels ? std::sqrt(sum / static_cast<double>(pixels)) : 0.0;
}
}  // namespace

TruthWorker::TruthWorker(int samples, std::function<void()> wake)
    : samples_(samples), wake_(std::move(wake)), thread_([this] { run(); }) {}

TruthWorker::~TruthWorker() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    ++question_;
  }
  changed_.notify_one();
  thread_.join();
}

void TruthWorker::ask(const View& view) {
  {
    const std::lock_guard lock(mutex_);
    if (asked_ && sameTruth(*asked_, view)) return;
    asked_ = wanted_ = view;
    image_ = nullptr;
    state_ = {};
    ++question_;
  }
  changed_.notify_one();
}

void TruthWorker::forget() {
  const std::lock_guard lock(mutex_);
  if (!asked_) return;
  asked_ = wanted_ = std::nullopt;
  image_ = nullptr;
  state_ = {.done = true};
  ++question_;
}

std::shared_ptr<const TruthImage> TruthWorker::image() const {
  const std::lock_guard lock(mutex_);
  return image_;
}

TruthWorker::State TruthWorker::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void TruthWorker::run() {
  for (;;) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return ends_ || wanted_; });
    if (ends_) return;
    const View view = std::move(*wanted_);
    wanted_ = std::nullopt;
    const std::uint64_t question = question_.load();
    lock.unlock();
    trace(view, question);
  }
}

void TruthWorker::fail(std::uint64_t question, const std::string& message) {
  {
    const std::lock_guard lock(mutex_);
    if (isStale(question)) return;
    state_ = {.done = true, .error = message};
  }
  wake_();
}

void TruthWorker::trace(const View& view, std::uint64_t question) {
  const scene::AreaLight& light = view.lights.front();
  const auto receivers = reference::traceReceivers(*view.scene, view.camera, light, view.width, view.height);
  if (!receivers) return fail(question, receivers.error().message);
  TruthImage sum{.width = view.width, .height = view.height, .kind = receivers->kind};
  sum.visibility.assign(receivers->kind.size(), 0.0f);
  reference::ReferenceOptions options{
      .samples = kFirstSamples,
      .threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1)};
  options.isCancelled = [&] { return isStale(question); };
  while (sum.samples < samples_) {
    options.samples = std::min(options.samples, samples_ - sum.samples);
    const int samples = reference::tracedSamples(options.samples);
    options.progress = [&](double share) {
      const std::lock_guard lock(mutex_);
      if (!isStale(question)) state_.share = (sum.samples + samples * share) / samples_;
    };
    // One call a round: each sorts the whole scene anew, which for a large one takes longer than its rays.
    const auto round = reference::traceVisibility(*view.scene, light, *receivers, options);
    if (!round) return fail(question, round.error().message);
    if (isStale(question)) return;
    const float share = static_cast<float>(samples) / static_cast<float>(sum.samples + samples);
    for (std::size_t i = 0; i < sum.visibility.size(); ++i)
      sum.visibility[i] += ((*round)[i] - sum.visibility[i]) * share;
    sum.samples += samples;
    sum.noiseAtMost = noiseOf(sum);
    {
      const std::lock_guard lock(mutex_);
      if (isStale(question)) return;
      image_ = std::make_shared<const TruthImage>(sum);
      state_.done = sum.samples >= samples_;
    }
    wake_();
    ++options.seed;
    options.samples *= 4;
  }
}

}  // namespace halfshadow::viewer
