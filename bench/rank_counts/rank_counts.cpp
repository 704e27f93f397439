// SPDX-License-Identifier: GPL-3.0-or-later
// rank_counts: what each rank of an MPI program sends, and what MUMPS says of its share; for
// LD_PRELOAD with CLATTER_RANK_COUNTS=prefix. Each rank writes prefix.RANK, one line of JSON for
// every call of MUMPS and one at the end. Point-to-point messages are counted where they are sent;
// of broadcasts, reductions and exchanges the bytes that the rank contributes.
#include <dlfcn.h>
#include <dmumps_c.h>
#include <mpi.h>
#include <time.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

namespace {

struct Counts {
  int64_t messages = 0, bytes = 0, collectives = 0, collective_bytes = 0;
};
Counts of_mumps, of_others;
bool in_mumps = false;
double mumps_seconds = 0.0, mumps_processor_seconds = 0.0;

Counts& current() { return in_mumps ? of_mumps : of_others; }

int64_t size_of(MPI_Datatype type) {
  int size = 0;
  MPI_Type_size(type, &size);
  return size;
}

void count_message(int count, MPI_Datatype type, int to) {
  int rank = 0;
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (to == rank || to == MPI_PROC_NULL) return;
  ++current().messages;
  current().bytes += count * size_of(type);
}

void count_collective(int count, MPI_Datatype type) {
  ++current().collectives;
  current().collective_bytes += count * size_of(type);
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double processor_now() {
  timespec spent{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &spent);
  return static_cast<double>(spent.tv_sec) + 1e-9 * static_cast<double>(spent.tv_nsec);
}

int64_t peak_kib() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmHWM:", 0) == 0) return std::atoll(line.c_str() + 6);
  return 0;
}

std::FILE* output() {
  static std::FILE* file = [] {
    const char* prefix = std::getenv("CLATTER_RANK_COUNTS");
    int rank = 0;
    PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return std::fopen(
        ((prefix != nullptr ? prefix : "rank_counts") + std::string(".") + std::to_string(rank))
            .c_str(),
        "w");
  }();
  return file;
}

void write_counts(std::FILE* file, const char* name, const Counts& counts) {
  std::fprintf(file,
               "\"%s\": {\"messages\": %lld, \"bytes\": %lld, \"collectives\": %lld, "
               "\"collective_bytes\": %lld}",
               name, static_cast<long long>(counts.messages), static_cast<long long>(counts.bytes),
               static_cast<long long>(counts.collectives),
               static_cast<long long>(counts.collective_bytes));
}

void write_mumps(const DMUMPS_STRUC_C& data, double seconds, double processor_seconds) {
  std::FILE* file = output();
  if (file == nullptr) return;
  std::fprintf(
      file,
      "{\"job\": %d, \"sym\": %d, \"seconds\": %.6f, \"processor_seconds\": %.6f, \"nrhs\": %d, "
      "\"info\": [",
      static_cast<int>(data.job), static_cast<int>(data.sym), seconds, processor_seconds,
      static_cast<int>(data.nrhs));
  for (int i = 0; i < 40; ++i) std::fprintf(file, "%s%d", i ? ", " : "", data.info[i]);
  std::fprintf(file, "], \"infog\": [");
  for (int i = 0; i < 40; ++i) std::fprintf(file, "%s%d", i ? ", " : "", data.infog[i]);
  std::fprintf(file, "], \"rinfo\": [%.17g, %.17g, %.17g], \"rinfog\": [%.17g, %.17g, %.17g], ",
               data.rinfo[0], data.rinfo[1], data.rinfo[2], data.rinfog[0], data.rinfog[1],
               data.rinfog[2]);
  write_counts(file, "mumps", of_mumps);
  std::fprintf(file, ", \"peak_kib\": %lld}\n", static_cast<long long>(peak_kib()));
  std::fflush(file);
}

}  // namespace

extern "C" {

void dmumps_c(DMUMPS_STRUC_C* data) {
  using Call = void (*)(DMUMPS_STRUC_C*);
  static const auto call = reinterpret_cast<Call>(dlsym(RTLD_NEXT, "dmumps_c"));
  const double begin = now(), processor_begin = processor_now();
  in_mumps = true;
  call(data);
  in_mumps = false;
  const double seconds = now() - begin, processor_seconds = processor_now() - processor_begin;
  mumps_seconds += seconds;
  mumps_processor_seconds += processor_seconds;
  if (data->job >= 1) write_mumps(*data, seconds, processor_seconds);
}

int MPI_Finalize() {
  if (std::FILE* file = output(); file != nullptr) {
    std::fprintf(file,
                 "{\"job\": 0, \"mumps_seconds\": %.6f, \"mumps_processor_seconds\": %.6f, "
                 "\"processor_seconds\": %.6f, ",
                 mumps_seconds, mumps_processor_seconds, processor_now());
    write_counts(file, "mumps", of_mumps);
    std::fprintf(file, ", ");
    write_counts(file, "others", of_others);
    std::fprintf(file, ", \"peak_kib\": %lld}\n", static_cast<long long>(peak_kib()));
    std::fclose(file);
  }
  return PMPI_Finalize();
}

// Sends: of C (our programs, ScaLAPACK) and of Fortran (MUMPS).
#define COUNTED_SEND(Name, fortran)                                                                \
  int MPI_##Name(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) { \
    count_message(count, type, to);                                                                \
    return PMPI_##Name(data, count, type, to, tag, comm);                                          \
  }                                                                                                \
  void pmpi_##fortran##_(void*, MPI_Fint*, MPI_Fint*, MPI_Fint*, MPI_Fint*, MPI_Fint*, MPI_Fint*); \
  void mpi_##fortran##_(void* data, MPI_Fint* count, MPI_Fint* type, MPI_Fint* to, MPI_Fint* tag,  \
                        MPI_Fint* comm, MPI_Fint* error) {                                         \
    count_message(*count, MPI_Type_f2c(*type), *to);                                               \
    pmpi_##fortran##_(data, count, type, to, tag, comm, error);                                    \
  }
#define COUNTED_ISEND(Name, fortran)                                                              \
  int MPI_##Name(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,  \
                 MPI_Request* request) {                                                          \
    count_message(count, type, to);                                                               \
    return PMPI_##Name(data, count, type, to, tag, comm, request);                                \
  }                                                                                               \
  void pmpi_##fortran##_(void*, MPI_Fint*, MPI_Fint*, MPI_Fint*, MPI_Fint*, MPI_Fint*, MPI_Fint*, \
                         MPI_Fint*);                                                              \
  void mpi_##fortran##_(void* data, MPI_Fint* count, MPI_Fint* type, MPI_Fint* to, MPI_Fint* tag, \
                        MPI_Fint* comm, MPI_Fint* request, MPI_Fint* error) {                     \
    count_message(*count, MPI_Type_f2c(*type), *to);                                              \
    pmpi_##fortran##_(data, count, type, to, tag, comm, request, error);                          \
  }

COUNTED_SEND(Send, send)
COUNTED_SEND(Ssend, ssend)
COUNTED_SEND(Rsend, rsend)
COUNTED_ISEND(Isend, isend)
COUNTED_ISEND(Issend, issend)

// Collectives: of C and of Fortran.
int MPI_Allreduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op,
                  MPI_Comm comm) {
  count_collective(count, type);
  return PMPI_Allreduce(in, out, count, type, op, comm);
}
int MPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm comm) {
  count_collective(count, type);
  return PMPI_Bcast(data, count, type, root, comm);
}
void pmpi_allreduce_(void*, void*, MPI_Fint*, MPI_Fint*, MPI_Fint*, MPI_Fint*, MPI_Fint*);
void mpi_allreduce_(void* in, void* out, MPI_Fint* count, MPI_Fint* type, MPI_Fint* op,
                    MPI_Fint* comm, MPI_Fint* error) {
  count_collective(*count, MPI_Type_f2c(*type));
  pmpi_allreduce_(in, out, count, type, op, comm, error);
}
void pmpi_reduce_(void*, void*, MPI_Fint*, MPI_Fint*, MPI_Fint*, MPI_Fint*, MPI_Fint*, MPI_Fint*);
void mpi_reduce_(void* in, void* out, MPI_Fint* count, MPI_Fint* type, MPI_Fint* op, MPI_Fint* root,
                 MPI_Fint* comm, MPI_Fint* error) {
  count_collective(*count, MPI_Type_f2c(*type));
  pmpi_reduce_(in, out, count, type, op, root, comm, error);
}
void pmpi_bcast_(void*, MPI_Fint*, MPI_Fint*, MPI_Fint*, MPI_Fint*, MPI_Fint*);
void mpi_bcast_(void* data, MPI_Fint* count, MPI_Fint* type, MPI_Fint* root, MPI_Fint* comm,
                MPI_Fint* error) {
  count_collective(*count, MPI_Type_f2c(*type));
  pmpi_bcast_(data, count, type, root, comm, error);
}

}  // extern "C"
