// SPDX-License-Identifier: Apache-2.0
#include "program/base/ranks.hpp"

#ifdef RIIS_PROGRAM_MPI
#include <mpi.h>
#endif

namespace riis::program::ranks {

#ifdef RIIS_PROGRAM_MPI

namespace {

int own_rank = 0, number = 1;

// An MPI type for an element of several bytes. A message of MPI has fewer than 2^31 elements. If an element has several bytes,
// the message may therefore have more than 2^31 bytes.
class ElementType {
 public:
  explicit ElementType(std::size_t size) {
    MPI_Type_contiguous(static_cast<int>(size), MPI_BYTE, &type_);
    MPI_Type_commit(&type_);
  }
  ~ElementType() { MPI_Type_free(&type_); }
  ElementType(const ElementType &) = delete;
  ElementType &operator=(const ElementType &) = delete;
  MPI_Datatype get() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

// The number of elements of each rank, and the position of each rank's first element, in the form that MPI takes.
struct Counts {
  explicit Counts(std::size_t n) : n_of(n), first(n) {}
  void add_up() { std::exclusive_scan(n_of.begin(), n_of.end(), first.begin(), 0); }
  std::size_t total() const { return static_cast<std::size_t>(first.back() + n_of.back()); }

  std::vector<int> n_of, first;
};

}  // namespace

Session::Session(int *argc, char ***argv) {
  MPI_Init(argc, argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &own_rank);
  MPI_Comm_size(MPI_COMM_WORLD, &number);
}
Session::~Session() { MPI_Finalize(); }

int rank() { return own_rank; }
int n_ranks() { return number; }

Alone::Alone() : n_ranks_(number) { number = 1; }
Alone::~Alone() { number = n_ranks_; }

void agree(const Refusal *failure) {
  if (number == 1) {
    if (failure) throw AgreedRefusal{*failure};
    return;
  }
  int first = failure ? own_rank : number;
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  if (first == number) return;
  AgreedRefusal agreed{first == own_rank ? *failure : Refusal{exit_bad_data, ""}};
  int code = agreed.refusal.exit_code, length = static_cast<int>(agreed.refusal.text.size());
  MPI_Bcast(&code, 1, MPI_INT, first, MPI_COMM_WORLD);
  MPI_Bcast(&length, 1, MPI_INT, first, MPI_COMM_WORLD);
  agreed.refusal.exit_code = static_cast<ExitCode>(code);
  agreed.refusal.text.resize(static_cast<std::size_t>(length));
  MPI_Bcast(agreed.refusal.text.data(), length, MPI_BYTE, first, MPI_COMM_WORLD);
  throw agreed;
}

std::vector<std::byte> gather_bytes(const void *own, std::size_t n_bytes, std::size_t element_size) {
  agree();
  const ElementType type(element_size);
  Counts counts(static_cast<std::size_t>(number));
  const int n = static_cast<int>(n_bytes / element_size);
  MPI_Allgather(&n, 1, MPI_INT, counts.n_of.data(), 1, MPI_INT, MPI_COMM_WORLD);
  counts.add_up();
  std::vector<std::byte> all(counts.total() * element_size);
  MPI_Allgatherv(own, n, type.get(), all.data(), counts.n_of.data(), counts.first.data(), type.get(), MPI_COMM_WORLD);
  return all;
}

std::vector<std::byte> exchange_bytes(const void *sent, const std::vector<std::size_t> &n_for_rank,
                                      std::size_t element_size) {
  agree();
  const ElementType type(element_size);
  Counts to(n_for_rank.size()), from(n_for_rank.size());
  for (std::size_t i = 0; i < n_for_rank.size(); ++i) to.n_of[i] = static_cast<int>(n_for_rank[i]);
  MPI_Alltoall(to.n_of.data(), 1, MPI_INT, from.n_of.data(), 1, MPI_INT, MPI_COMM_WORLD);
  to.add_up();
  from.add_up();
  std::vector<std::byte> all(from.total() * element_size);
  MPI_Alltoallv(sent, to.n_of.data(), to.first.data(), type.get(), all.data(), from.n_of.data(), from.first.data(),
                type.get(), MPI_COMM_WORLD);
  return all;
}

#else

Session::Session(int *, char ***) {}
Session::~Session() = default;

int rank() { return 0; }
int n_ranks() { return 1; }

Alone::Alone() : n_ranks_(1) {}
Alone::~Alone() = default;

void agree(const Refusal *failure) {
  if (failure) throw AgreedRefusal{*failure};
}

// Without MPI there is one rank. gather and exchange then return their argument, and never call these two functions.
std::vector<std::byte> gather_bytes(const void *, std::size_t, std::size_t) { return {}; }
std::vector<std::byte> exchange_bytes(const void *, const std::vector<std::size_t> &, std::size_t) { return {}; }

#endif

}  // namespace riis::program::ranks
