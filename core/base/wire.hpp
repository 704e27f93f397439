// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Binary serialisation between a parent and its child process: same program, same machine, so no
// stable format is needed.
//
// Numbers, texts, vectors, maps, pairs, optional values and Eigen matrices are built in. A struct S
// needs, found by argument-dependent look-up,
//   template <class Archive, class Self> requires same_as<remove_const_t<Self>, S>
//   void wire(Archive& archive, Self& s) { auto& [a, b] = s; archive(a, b); }
// whose binding fails to compile when S gets another member.
#include <Eigen/Core>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/error.hpp"

namespace clatter {

template <class T>
concept PlainNumber = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// Appends values to bytes.
class WireWriter {
 public:
  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }
  std::string take() { return std::move(bytes_); }

 private:
  void raw(const void* from, size_t size) { bytes_.append(static_cast<const char*>(from), size); }
  void count(size_t n) { put(static_cast<uint64_t>(n)); }

  template <PlainNumber T>
  void put(const T& value) {
    raw(&value, sizeof value);
  }
  void put(const std::string& text) {
    count(text.size());
    raw(text.data(), text.size());
  }
  template <class T>
  void put(const std::vector<T>& list) {
    count(list.size());
    if constexpr (PlainNumber<T>) {
      raw(list.data(), list.size() * sizeof(T));
    } else {
      for (const T& value : list) put(value);
    }
  }
  template <class K, class V>
  void put(const std::map<K, V>& map) {
    count(map.size());
    for (const auto& [key, value] : map) (*this)(key, value);
  }
  template <class A, class B>
  void put(const std::pair<A, B>& both) {
    (*this)(both.first, both.second);
  }
  template <class T>
  void put(const std::optional<T>& value) {
    put(static_cast<char>(value.has_value()));
    if (value) put(*value);
  }
  template <class S, int R, int C, int O, int MR, int MC>
  void put(const Eigen::Matrix<S, R, C, O, MR, MC>& matrix) {
    count(static_cast<size_t>(matrix.rows()));
    count(static_cast<size_t>(matrix.cols()));
    raw(matrix.data(), static_cast<size_t>(matrix.size()) * sizeof(S));
  }
  template <class S>
  void put(const S& object) {
    wire(*this, object);
  }

  std::string bytes_;
};

/// Reads values in the order written. NumericsError when the bytes end too early.
class WireReader {
 public:
  explicit WireReader(const std::string& bytes) : at_(bytes.data()), left_(bytes.size()) {}
  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }

 private:
  void raw(void* to, size_t size) {
    if (size > left_) throw NumericsError("the result of a child process is truncated");
    if (size > 0) std::memcpy(to, at_, size);
    at_ += size;
    left_ -= size;
  }
  // Each entry takes at least `bytes_each`, so a wrong count allocates no memory.
  size_t count(size_t bytes_each) {
    uint64_t n = 0;
    get(n);
    if (bytes_each > 0 && n > left_ / bytes_each)
      throw NumericsError("the result of a child process is truncated");
    return static_cast<size_t>(n);
  }

  template <PlainNumber T>
  void get(T& value) {
    raw(&value, sizeof value);
  }
  void get(std::string& text) {
    text.resize(count(1));
    raw(text.data(), text.size());
  }
  template <class T>
  void get(std::vector<T>& list) {
    list.resize(count(PlainNumber<T> ? sizeof(T) : 1));
    if constexpr (PlainNumber<T>) {
      raw(list.data(), list.size() * sizeof(T));
    } else {
      for (T& value : list) get(value);
    }
  }
  template <class K, class V>
  void get(std::map<K, V>& map) {
    map.clear();
    for (size_t n = count(1); n > 0; --n) {
      K key{};
      get(key);
      get(map[key]);
    }
  }
  template <class A, class B>
  void get(std::pair<A, B>& both) {
    (*this)(both.first, both.second);
  }
  template <class T>
  void get(std::optional<T>& value) {
    char present = 0;
    get(present);
    value.reset();
    if (present != 0) get(value.emplace());
  }
  template <class S, int R, int C, int O, int MR, int MC>
  void get(Eigen::Matrix<S, R, C, O, MR, MC>& matrix) {
    const size_t rows = count(0), columns = count(0);
    if (columns > 0 && rows > left_ / sizeof(S) / columns)
      throw NumericsError("the result of a child process is truncated");
    matrix.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
    raw(matrix.data(), static_cast<size_t>(matrix.size()) * sizeof(S));
  }
  template <class S>
  void get(S& object) {
    wire(*this, object);
  }

  const char* at_;
  size_t left_;
};

template <class T>
std::string to_wire(const T& value) {
  WireWriter writer;
  writer(value);
  return writer.take();
}

template <class T>
T from_wire(const std::string& bytes) {
  T value{};
  WireReader reader(bytes);
  reader(value);
  return value;
}

/// Self is S or const S.
template <class Self, class S>
concept SelfOf = std::same_as<std::remove_const_t<Self>, S>;

}  // namespace clatter
