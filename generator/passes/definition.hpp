// Another way to compute a value of a program than its own operation.
#pragma once

#include <cstdint>

#include "ir/builder.hpp"

namespace jourdain::passes {

struct Definition {
  enum class Kind : std::uint8_t {
    kOwn,      ///< the operation that the program has
    kSum,      ///< x + y
    kProduct,  ///< x y
    kLine,     ///< factor x + offset
    kNumber    ///< offset
  };

  Kind kind = Kind::kOwn;
  ir::Signed x{}, y{};
  bool is_scaled = false, is_shifted = false;  ///< have lines a factor, an offset?
  cln::cl_R factor = 1, offset = 0;

  /// Values that it reads, x before y; of the program's own operation that is not said here.
  int operands() const {
    return kind == Kind::kSum || kind == Kind::kProduct ? 2 : kind == Kind::kLine ? 1 : 0;
  }
  /// Operations that it takes, the program's own apart.
  int operations() const { return kind == Kind::kLine ? int(is_scaled) + int(is_shifted) : operands() / 2; }
};

}  // namespace jourdain::passes
