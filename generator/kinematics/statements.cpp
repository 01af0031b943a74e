#include "kinematics/statements.hpp"

#include <fmt/format.h>

namespace jourdain::kinematics {

using GiNaC::is_a;

bool is_number(const Ex& value) { return is_a<GiNaC::numeric>(value); }

bool is_trivial(const Ex& value) { return value.is_zero() || value.is_equal(1) || value.is_equal(-1); }

Ex Statements::leaf(LeafKind kind, std::size_t index, const std::string& name) {
  leaves_.push_back({kind, index, GiNaC::realsymbol(name)});
  return leaves_.back().symbol;
}

Ex Statements::bind(const std::string& name, const Ex& value) {
  if (is_number(value) || is_a<GiNaC::symbol>(value) || is_a<GiNaC::symbol>(-value)) return value;
  statements_.push_back({GiNaC::realsymbol(name), value, {}});
  return statements_.back().name;
}

Ex Statements::hold(const std::string& name, const Ex& value) {
  statements_.push_back({GiNaC::realsymbol(name), value, held_++});
  return statements_.back().name;
}

Vector3 Statements::bind(const std::string& name, const Vector3& value) {
  return {bind(name + "_x", value[0]), bind(name + "_y", value[1]), bind(name + "_z", value[2])};
}

Matrix3 Statements::bind(const std::string& name, const Matrix3& value) {
  Matrix3 bound;
  for (std::size_t i = 0; i < 3; ++i) bound[i] = bind(fmt::format("{}{}", name, i), value[i]);
  return bound;
}

Matrix3 Statements::bind_symmetric(const std::string& name, const Matrix3& value) {
  constexpr const char* kAxis = "xyz";
  Matrix3 bound;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j)
      bound[i][j] = bound[j][i] = bind(fmt::format("{}_{}{}", name, kAxis[i], kAxis[j]), value[i][j]);
  return bound;
}

}  // namespace jourdain::kinematics
