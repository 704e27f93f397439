// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The processes (ranks) of an MPI program.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/sparse/row_team.hpp"

namespace clatter::ranks {

/// All ranks of the program, as the team that shares rows. Every function but rank() and size() is
/// collective: all ranks call it.
class Ranks : public sparse::RowTeam {
 public:
  int rank() const override { return rank_; }
  int size() const override { return size_; }
  void sum(double* values, int64_t count) const override;
  void least(double* values, int64_t count) const override;
  void agree(double* values, int64_t count) const override;
  RowMatrix gather(RowMatrix rows) const override;
  std::vector<int32_t> gather(std::vector<int32_t> values) const override;
  using RowTeam::least;
  using RowTeam::sum;

  /// values <- those of rank 0, resized.
  void share(std::vector<int32_t>& values) const;
  std::string share(std::string text) const;
  /// Bytes out[r] go to rank r; the result has at r what rank r sent.
  std::vector<std::vector<char>> exchange(const std::vector<std::vector<char>>& out) const;
  /// The same for values of a plain type.
  template <class T>
  std::vector<std::vector<T>> exchange(const std::vector<std::vector<T>>& out) const {
    std::vector<std::vector<char>> bytes(out.size());
    for (size_t r = 0; r < out.size(); ++r) {
      const char* first = reinterpret_cast<const char*>(out[r].data());
      bytes[r].assign(first, first + out[r].size() * sizeof(T));
    }
    const std::vector<std::vector<char>> received = exchange(bytes);
    std::vector<std::vector<T>> in(received.size());
    for (size_t r = 0; r < in.size(); ++r) {
      const T* first = reinterpret_cast<const T*>(received[r].data());
      in[r].assign(first, first + received[r].size() / sizeof(T));
    }
    return in;
  }
  /// One message of doubles to each rank and from each, of lengths known to both.
  void transfer(const std::vector<std::vector<double>>& out,
                std::vector<std::vector<double>>& in) const;
  /// Ranks of this machine.
  int on_this_machine() const { return on_this_machine_; }
  /// The communicator of all ranks as Fortran knows it, for MUMPS.
  int fortran_handle() const;
  /// Bytes that this rank sent to others so far.
  int64_t bytes_sent() const { return sent_; }

 private:
  friend int run_ranks(const std::string&, int&, char**&, const std::function<int(const Ranks&)>&);
  Ranks();
  int rank_ = 0, size_ = 1, on_this_machine_ = 1;
  mutable int64_t sent_ = 0;
};

/// Runs `body` on all ranks of an MPI program and returns its exit code. The lowest rank that fails
/// prints its error; each that fails ends with its code. Where others wait for a rank that failed
/// alone, for example because its memory is short, it ends all ranks with the code.
int run_ranks(const std::string& program, int& argc, char**& argv,
              const std::function<int(const Ranks&)>& body);

}  // namespace clatter::ranks
