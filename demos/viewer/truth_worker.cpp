// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "viewer/truth_worker.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "reference/reference.hpp"

namespace halfshadow::viewer {
namespace {
/// Of the first image; each further one has four times as many.
constexpr int kFirstSamples = 4;

/// Pixels a call, so that a question that has gone stale is left within about this time.
class ChunkSize {
 public:
  std::size_t pixels() const { return pixels_; }
  void took(std::chrono::steady_clock::duration time) {
    using namespace std::chrono_literals;
    if (time < 50ms) pixels_ *= 2;
    if (time > 200ms && pixels_ > 256) pixels_ /= 2;
  }

 private:
  std::size_t pixels_ = 8192;
};

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
  std::vector<std::uint32_t> pixels(receivers->kind.size());
  std::iota(pixels.begin(), pixels.end(), 0u);
  TruthImage sum{.width = view.width, .height = view.height, .kind = receivers->kind};
  sum.visibility.assign(pixels.size(), 0.0f);
  reference::ReferenceOptions options{
      .samples = kFirstSamples,
      .threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1)};
  ChunkSize chunk;
  while (sum.samples < samples_) {
    const int samples = reference::tracedSamples(std::min(options.samples, samples_ - sum.samples));
    for (std::size_t first = 0; first < pixels.size();) {
      if (isStale(question)) return;
      const std::size_t count = std::min(chunk.pixels(), pixels.size() - first);
      const auto begin = std::chrono::steady_clock::now();
      const auto part = reference::tracePixels(*view.scene, light, *receivers,
                                               std::span(pixels).subspan(first, count), options);
      if (!part) return fail(question, part.error().message);
      const float share = static_cast<float>(samples) / static_cast<float>(sum.samples + samples);
      for (std::size_t i = 0; i < count; ++i) {
        float& mean = sum.visibility[first + i];
        mean += ((*part)[i] - mean) * share;
      }
      first += count;
      chunk.took(std::chrono::steady_clock::now() - begin);
      const std::lock_guard lock(mutex_);
      if (isStale(question)) return;
      state_.share =
          (sum.samples + samples * static_cast<double>(first) / static_cast<double>(pixels.size())) /
          samples_;
    }
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
    options.samples = std::min(4 * options.samples, std::max(1, samples_ - sum.samples));
  }
}

}  // namespace halfshadow::viewer
