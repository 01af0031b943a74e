// What everybody asks the kinds of force elements: which expressions they hold, where they act, whether energy stays.
#include "model/force_elements.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace jourdain::model {
namespace {

bool is_time(const Variable& variable) { return variable.kind == Variable::Kind::kTime; }

template <class Element>
Element named(const char* name) {
  Element element;
  element.name = name;
  return element;
}

/// An element with one of its members set.
template <class Element, class Value>
Element with(Element element, Value Element::*member, const Value& value) {
  element.*member = value;
  return element;
}

TEST(ForceElements, AreVisitedByKindAsDeclared) {
  ForceElements all;
  all.bushings = {named<Bushing>("e")};
  all.loads = {named<Load>("d")};
  all.springs = {named<Spring>("b"), named<Spring>("c")};
  all.actuators = {named<Actuator>("a")};
  std::string order;
  for_each_force_element(all, [&order](const auto& element) { order += element.name; });
  EXPECT_EQ(order, "abcde");
  EXPECT_FALSE(has_inputs_alone(all));
  list_of<Spring>(all).clear();
  for_each_force_element(all, [&order](const auto& element) { order += element.name; });
  EXPECT_EQ(order, "abcdeade");
}

TEST(ForceElements, OfActuatorsAloneAreInputs) {
  ForceElements all;
  EXPECT_TRUE(has_inputs_alone(all));
  all.actuators.resize(2);
  EXPECT_TRUE(has_inputs_alone(all));
  all.coordinate_forces.resize(1);
  EXPECT_FALSE(has_inputs_alone(all));
}

/// Time is seen in each expression of the element, put there one after the other.
template <class Element>
void expect_all_seen(Element element, std::size_t count) {
  EXPECT_FALSE(any_variable(element, is_time));
  ASSERT_EQ(element.expressions().size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    Element moving = element;
    *moving.expressions()[i] = Expression::variable({Variable::Kind::kTime, 0, 0});
    EXPECT_TRUE(any_variable(moving, is_time)) << Element::kKind << " " << i;
  }
}

TEST(ForceElements, GiveAllTheirExpressions) {
  expect_all_seen(Actuator(), 2);
  expect_all_seen(CoordinateForce(), 1);
  expect_all_seen(Load(), 6);
  expect_all_seen(Spring(), 4);
  expect_all_seen(with(Spring(), &Spring::potential, std::optional(Expression(1.0))), 5);
  expect_all_seen(Bushing(), 12);
}

TEST(ForceElements, ConserveEnergyUnlessTheyDampOrHaveNoPotential) {
  EXPECT_TRUE(with(Spring(), &Spring::stiffness, Expression(3.0)).conserves_energy());
  EXPECT_FALSE(with(Spring(), &Spring::damping, Expression(3.0)).conserves_energy());
  const Spring lawful = with(Spring(), &Spring::law, Expression(3.0));
  EXPECT_FALSE(lawful.conserves_energy());
  EXPECT_TRUE(with(lawful, &Spring::potential, std::optional(Expression(1.0))).conserves_energy());
  const Vector3 one = {0.0, 0.0, 3.0};
  EXPECT_TRUE(with(Bushing(), &Bushing::stiffness, one).conserves_energy());
  EXPECT_TRUE(with(Bushing(), &Bushing::torsional_stiffness, one).conserves_energy());
  EXPECT_FALSE(with(Bushing(), &Bushing::damping, one).conserves_energy());
  EXPECT_FALSE(with(Bushing(), &Bushing::torsional_damping, one).conserves_energy());
  EXPECT_FALSE(Load().conserves_energy());
  EXPECT_FALSE(CoordinateForce().conserves_energy());
}

}  // namespace
}  // namespace jourdain::model
