// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A list that grows without moving its entries.
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace clatter::mesh::deck {

/// Grows in chunks of 65 536 entries, without extra memory while it grows. Short lists are plain
/// vectors.
template <class T>
class Chunked {
 public:
  size_t size() const { return size_; }

  void push_back(const T& value) {
    if (size_ < kPiece) {
      first_.push_back(value);
    } else {
      if (size_ % kPiece == 0)
        further_.push_back(std::make_unique_for_overwrite<std::array<T, kPiece>>());
      (*further_.back())[size_ % kPiece] = value;
    }
    ++size_;
  }

  T& operator[](size_t i) {
    return i < kPiece ? first_[i] : (*further_[i / kPiece - 1])[i % kPiece];
  }
  const T& operator[](size_t i) const { return const_cast<Chunked&>(*this)[i]; }

  /// Calls body(entry) for all in order and frees each chunk when it is done; then empty.
  template <class Body>
  void drain(const Body& body) {
    for (const T& value : first_) body(value);
    first_ = std::vector<T>();
    for (size_t i = kPiece; i < size_; ++i) {
      body((*this)[i]);
      if (i % kPiece == kPiece - 1) further_[i / kPiece - 1].reset();
    }
    further_.clear();
    size_ = 0;
  }

 private:
  static constexpr size_t kPiece = 65536;
  std::vector<T> first_;
  std::vector<std::unique_ptr<std::array<T, kPiece>>> further_;
  size_t size_ = 0;
};

}  // namespace clatter::mesh::deck
