// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Threads that a host lends: whatever it does with the work, each piece is done once, and lists are the same.
#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <vector>

#include "base/workers.hpp"
#include "near_surface_rig.hpp"
#include "threads/worker_threads.hpp"

namespace halfshadow::test {
namespace {
using Work = void (*)(std::size_t index, void* job);

struct Host {
  const char* name;
  Workers::ParallelFor parallelFor;
};
WorkerThreads three(3);
const Host kHosts[] = {{"three threads", [](std::size_t count, Work work, void* job,
                                            void*) { WorkerThreads::parallelFor(count, work, job, &three); }},
                       {"the last first",
                        [](std::size_t count, Work work, void* job, void*) {
                          while (count-- > 0) work(count, job);
                        }},
                       {"two of three",
                        [](std::size_t count, Work work, void* job, void*) {
                          for (std::size_t i = 0; i < count; ++i) {
                            if (i % 3 != 1) work(i, job);
                          }
                        }},
                       {"each twice, and what is not there",
                        [](std::size_t count, Work work, void* job, void*) {
                          for (std::size_t i = 0; i < count + 3; ++i) work(i, job), work(i, job);
                        }},
                       {"nothing", [](std::size_t, Work, void*, void*) {}}};

TEST(LentThreads, DoEachPieceOnce) {
  for (const Host& host : kHosts) {
    SCOPED_TRACE(host.name);
    for (const std::size_t count : {0u, 1u, 2u, 57u}) {
      std::vector<std::atomic<int>> done(count);
      Workers(host.parallelFor, nullptr).forEach(count, [&](std::size_t i) { ++done.at(i); });
      for (const std::atomic<int>& times : done) EXPECT_EQ(times, 1);
    }
  }
}

// No exception passes through the host, and no piece is left out because another failed.
TEST(LentThreads, GiveBackWhatPiecesThrow) {
  for (const Host& host : kHosts) {
    SCOPED_TRACE(host.name);
    std::atomic<int> done = 0;
    EXPECT_THROW(Workers(host.parallelFor, nullptr)
                     .forEach(20,
                              [&](std::size_t i) {
                                ++done;
                                if (i % 5 == 2) throw std::bad_alloc();
                              }),
                 std::bad_alloc);
    EXPECT_EQ(done, 20);
  }
}

TEST(LentThreads, MakeTheSameLists) {
  const struct {
    const char* name;
    scene::TriangleMesh shape;
    Surface surface;
    std::size_t mostOwnFacets;
  } kSubjects[] = {{"faces in lists", bumpyBall(40, 24), Surface::closed, ~std::size_t{0}},
                   {"trees", bumpyBall(90, 60), Surface::closed, 8},
                   {"a sheet's trees", bentSheet(60), Surface::open, 8}};
  for (const auto& [name, shape, surface, most] : kSubjects) {
    SCOPED_TRACE(name);
    const std::vector<double> alone = ownListNumbers(shape, 0.5, surface, most, {});
    ASSERT_GT(alone.size(), 1000u);
    for (const Host& host : kHosts) {
      SCOPED_TRACE(host.name);
      EXPECT_TRUE(ownListNumbers(shape, 0.5, surface, most, Workers(host.parallelFor, nullptr)) == alone);
    }
  }
}

}  // namespace
}  // namespace halfshadow::test
