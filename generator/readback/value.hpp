// Values while text is executed, and the memory that objects live in.
#pragma once

#include <vector>

#include "readback/domain.hpp"
#include "readback/types.hpp"

namespace jourdain::readback {

/// The result of an expression: a number, an integer, a constant of type double, a place in memory, a pointer.
struct Value {
  enum class Kind : std::uint8_t { kNothing, kBool, kInteger, kNative, kNumber, kPlace, kPointer, kList };
  Kind kind = Kind::kNothing;
  bool is_const = false;  ///< kPlace, kPointer: what is there must not change
  Number number = 0;
  long integer = 0;  ///< kInteger, kBool
  double native = 0;
  const Type* type = nullptr;        ///< kPlace; kPointer: of what is pointed to
  std::size_t address = 0;           ///< kPlace, kPointer
  std::size_t begin = 0, end = 0;    ///< kPointer: the array that it stays in
  const Expression* list = nullptr;  ///< kList
};

/// One scalar.
struct Cell {
  enum class Kind : std::uint8_t { kUnset, kNumber, kInteger };
  Kind kind = Kind::kUnset;
  Number number = 0;
  long integer = 0;

  friend bool operator==(const Cell&, const Cell&) = default;
};

inline Cell number_cell(Number number) { return {Cell::Kind::kNumber, number, 0}; }
inline Cell integer_cell(long integer) { return {Cell::Kind::kInteger, 0, integer}; }

}  // namespace jourdain::readback
