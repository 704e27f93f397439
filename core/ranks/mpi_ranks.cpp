// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>
#include <thread>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/part_names.hpp"
#include "core/base/refusal.hpp"
#include "core/ranks/ranks.hpp"

namespace clatter::ranks {
namespace {

constexpr int64_t kMost = int64_t{1} << 30;  // of bytes or values in a message: MPI counts in ints
constexpr int kTag = 1;
const MPI_Comm kAll = MPI_COMM_WORLD;

/// body(offset, count) for pieces that an int counts.
template <class Body>
void in_pieces(int64_t count, Body&& body) {
  for (int64_t at = 0; at < count; at += kMost)
    body(at, static_cast<int>(std::min(kMost, count - at)));
}

/// Messages that are under way.
class Messages {
 public:
  void send(int to, const void* data, int64_t bytes) {
    in_pieces(bytes, [&](int64_t at, int count) {
      MPI_Isend(static_cast<const char*>(data) + at, count, MPI_BYTE, to, kTag, kAll, &next());
    });
  }
  void receive(int from, void* data, int64_t bytes) {
    in_pieces(bytes, [&](int64_t at, int count) {
      MPI_Irecv(static_cast<char*>(data) + at, count, MPI_BYTE, from, kTag, kAll, &next());
    });
  }
  void wait() {
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  }

 private:
  MPI_Request& next() { return requests_.emplace_back(MPI_REQUEST_NULL); }
  std::vector<MPI_Request> requests_;
};

/// The end of this rank's work.
enum class End { kDone, kFailed };

/// The lowest rank that failed, or their number; none where after a failure not all ranks come here
/// within a few seconds: then some wait for this one elsewhere.
std::optional<int> lowest_failed(End end) {
  constexpr auto kPatience = std::chrono::seconds(3);
  constexpr auto kPause = std::chrono::milliseconds(5);
  int rank = 0, size = 1;
  MPI_Comm_rank(kAll, &rank);
  MPI_Comm_size(kAll, &size);
  const int own = end == End::kFailed ? rank : size;
  int lowest = size, done = 0;
  MPI_Request request;
  MPI_Iallreduce(&own, &lowest, 1, MPI_INT, MPI_MIN, kAll, &request);
  const auto limit = std::chrono::steady_clock::now() + kPatience;
  for (;;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done != 0) return lowest;
    if (end == End::kFailed && std::chrono::steady_clock::now() > limit) return std::nullopt;
    std::this_thread::sleep_for(kPause);
  }
}

/// Ends all ranks after an error of this one, or of all.
int end_after(const std::string& program, const std::string& message, ExitCode code) {
  int rank = 0;
  MPI_Comm_rank(kAll, &rank);
  const std::optional<int> lowest = lowest_failed(End::kFailed);
  if (lowest) {
    if (rank == *lowest) report_error(program, message, code);
    MPI_Finalize();
    return static_cast<int>(code);
  }
  report_error(program, fmt::format("rank {}: {}", rank, message), code);
  MPI_Abort(kAll, static_cast<int>(code));
  return static_cast<int>(code);
}

}  // namespace

Ranks::Ranks() {
  MPI_Comm_rank(kAll, &rank_);
  MPI_Comm_size(kAll, &size_);
  MPI_Comm machine;
  MPI_Comm_split_type(kAll, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  MPI_Comm_size(machine, &on_this_machine_);
  MPI_Comm_free(&machine);
}

void Ranks::sum(double* values, int64_t count) const {
  in_pieces(count, [&](int64_t at, int part) {
    MPI_Allreduce(MPI_IN_PLACE, values + at, part, MPI_DOUBLE, MPI_SUM, kAll);
  });
  sent_ += size_ > 1 ? 8 * count : 0;
}

void Ranks::least(double* values, int64_t count) const {
  in_pieces(count, [&](int64_t at, int part) {
    MPI_Allreduce(MPI_IN_PLACE, values + at, part, MPI_DOUBLE, MPI_MIN, kAll);
  });
}

void Ranks::agree(double* values, int64_t count) const {
  in_pieces(count,
            [&](int64_t at, int part) { MPI_Bcast(values + at, part, MPI_DOUBLE, 0, kAll); });
}

RowMatrix Ranks::gather(RowMatrix rows) const {
  std::vector<std::vector<double>> out(static_cast<size_t>(size_));
  out[0].assign(rows.data(), rows.data() + rows.size());
  const std::vector<std::vector<double>> in = exchange(out);
  std::vector<double> all;
  for (const auto& part : in) all.insert(all.end(), part.begin(), part.end());
  const Eigen::Index columns = rows.cols();
  const auto count = static_cast<Eigen::Index>(all.size()) / std::max<Eigen::Index>(columns, 1);
  return Eigen::Map<const RowMatrix>(all.data(), count, columns);
}

std::vector<int32_t> Ranks::gather(std::vector<int32_t> values) const {
  std::vector<std::vector<int32_t>> out(static_cast<size_t>(size_));
  out[0] = std::move(values);
  std::vector<int32_t> all;
  for (const auto& part : exchange(out)) all.insert(all.end(), part.begin(), part.end());
  return all;
}

void Ranks::share(std::vector<int32_t>& values) const {
  auto count = static_cast<int64_t>(values.size());
  MPI_Bcast(&count, 1, MPI_INT64_T, 0, kAll);
  values.resize(count);
  in_pieces(count, [&](int64_t at, int part) {
    MPI_Bcast(values.data() + at, part, MPI_INT32_T, 0, kAll);
  });
}

std::string Ranks::share(std::string text) const {
  std::vector<int32_t> letters(text.begin(), text.end());
  share(letters);
  return {letters.begin(), letters.end()};
}

std::vector<std::vector<char>> Ranks::exchange(const std::vector<std::vector<char>>& out) const {
  const auto all = static_cast<size_t>(size_);
  std::vector<int64_t> sizes(all), expected(all);
  for (size_t r = 0; r < all; ++r) sizes[r] = static_cast<int64_t>(out[r].size());
  MPI_Alltoall(sizes.data(), 1, MPI_INT64_T, expected.data(), 1, MPI_INT64_T, kAll);
  std::vector<std::vector<char>> in(all);
  Messages messages;
  for (size_t r = 0; r < all; ++r) {
    in[r].resize(expected[r]);
    messages.receive(static_cast<int>(r), in[r].data(), expected[r]);
  }
  for (size_t r = 0; r < all; ++r) {
    messages.send(static_cast<int>(r), out[r].data(), sizes[r]);
    if (static_cast<int>(r) != rank_) sent_ += sizes[r];
  }
  messages.wait();
  return in;
}

void Ranks::transfer(const std::vector<std::vector<double>>& out,
                     std::vector<std::vector<double>>& in) const {
  Messages messages;
  for (size_t r = 0; r < in.size(); ++r)
    messages.receive(static_cast<int>(r), in[r].data(), 8 * static_cast<int64_t>(in[r].size()));
  for (size_t r = 0; r < out.size(); ++r) {
    const int64_t bytes = 8 * static_cast<int64_t>(out[r].size());
    messages.send(static_cast<int>(r), out[r].data(), bytes);
    if (static_cast<int>(r) != rank_) sent_ += bytes;
  }
  messages.wait();
}

int Ranks::fortran_handle() const { return static_cast<int>(MPI_Comm_c2f(kAll)); }

int run_ranks(const std::string& program, int& argc, char**& argv,
              const std::function<int(const Ranks&)>& body) {
  MPI_Init(&argc, &argv);
  remove_parts_on_signals();
  try {
    const Ranks all;
    if (all.rank() > 0) set_log_sink([](bool, const std::string&) {});  // rank 0 speaks for all
    const int code = body(all);
    (void)lowest_failed(End::kDone);
    MPI_Finalize();
    return code;
  } catch (const Error& error) {
    return end_after(program, error.what(), error.code());
  } catch (const std::bad_alloc&) {
    return end_after(program, "out of memory: use more ranks, or a coarser mesh",
                     ExitCode::kNumerics);
  } catch (const std::exception& error) {
    return end_after(program, std::string("internal: ") + error.what(), ExitCode::kNumerics);
  }
}

}  // namespace clatter::ranks
