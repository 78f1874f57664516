// SPDX-License-Identifier: Apache-2.0
// The processes of a run. If the program was built without MPI or started without mpirun, there is one process. With mpirun there
// are several processes, the ranks, and every rank takes its share of a mesh's pieces. Only ranks.cpp calls MPI.

// All ranks call the exchanges in the same order. Each exchange begins with an agreement, in which all ranks learn whether one of
// them has failed. A rank that fails outside an exchange makes one more agreement, at the end of the program. The other ranks
// learn of the failure in their next agreement. All ranks then end with the message of the lowest failed rank, so no rank waits
// forever.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <type_traits>
#include <vector>

#include "program/base/refusal.hpp"

namespace riis::program::ranks {

// Starts and ends MPI.
class Session {
 public:
  Session(int *argc, char ***argv);
  ~Session();
  Session(const Session &) = delete;
  Session &operator=(const Session &) = delete;
};

int rank();
int n_ranks();
// Only the first rank prints, and only this rank writes the files that all ranks share.
inline bool is_first() { return rank() == 0; }

// While an object of this type lives, the first rank works alone, and exchanges and agreements do not involve the other ranks.
// The other ranks wait in the agreement at the end of the program.
class Alone {
 public:
  Alone();
  ~Alone();
  Alone(const Alone &) = delete;
  Alone &operator=(const Alone &) = delete;

 private:
  [[maybe_unused]] int n_ranks_;  // used with MPI
};

// A failure that all ranks know of.
struct AgreedRefusal {
  Refusal refusal;
};

// Throws an AgreedRefusal on all ranks if at least one rank passes a failure.
void agree(const Refusal *failure = nullptr);

// Returns the bytes that all ranks passed, in the order of the ranks.
std::vector<std::byte> gather_bytes(const void *own, std::size_t n_bytes, std::size_t element_size);
// Sends the i-th part of `sent` to rank i. Returns the parts that all ranks sent to this rank.
std::vector<std::byte> exchange_bytes(const void *sent, const std::vector<std::size_t> &n_for_rank,
                                      std::size_t element_size);

// Returns the elements of all ranks, in the order of the ranks. Every rank gets all elements.
template <class T>
std::vector<T> gather(const std::vector<T> &own) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (n_ranks() == 1) return own;
  const std::vector<std::byte> bytes = gather_bytes(own.data(), own.size() * sizeof(T), sizeof(T));
  const auto *const begin = reinterpret_cast<const T *>(bytes.data());
  return {begin, begin + bytes.size() / sizeof(T)};
}

// Returns the sum of the numbers that all ranks passed.
inline std::int64_t sum(std::int64_t own) {
  const std::vector<std::int64_t> all = gather(std::vector<std::int64_t>{own});
  return std::accumulate(all.begin(), all.end(), std::int64_t{0});
}

// Sends each element to the rank rank_of(element), and returns the elements that were sent to this rank.
template <class T, class RankOf>
std::vector<T> exchange(std::vector<T> own, const RankOf &rank_of) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (n_ranks() == 1) return own;
  std::vector<std::size_t> n_for(static_cast<std::size_t>(n_ranks())), next(n_for.size());
  for (const T &element : own) ++n_for[rank_of(element)];
  for (std::size_t i = 1; i < next.size(); ++i) next[i] = next[i - 1] + n_for[i - 1];
  std::vector<T> sorted(own.size());
  for (const T &element : own) sorted[next[rank_of(element)]++] = element;
  own = {};
  const std::vector<std::byte> bytes = exchange_bytes(sorted.data(), n_for, sizeof(T));
  sorted = {};
  const auto *const begin = reinterpret_cast<const T *>(bytes.data());
  return {begin, begin + bytes.size() / sizeof(T)};
}

}  // namespace riis::program::ranks
