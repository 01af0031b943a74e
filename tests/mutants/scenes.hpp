// The mechanisms that faults are planted in: small, and between them every kind of joint, force, output and treatment.
#pragma once

#include <vector>

#include "mutants/subject.hpp"

namespace jourdain::tests {

std::vector<model::Mechanism> tree_scenes();
/// Four-bars and slider-cranks by every treatment, one with stabilisation.
std::vector<model::Mechanism> loop_scenes();

std::vector<Subject> tree_subjects();
std::vector<Subject> loop_subjects();

}  // namespace jourdain::tests
