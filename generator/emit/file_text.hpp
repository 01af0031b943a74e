// What emitted files say about a model beside its programs, in any language.
#pragma once

#include <string>
#include <vector>

#include "ir/module.hpp"
#include "ir/text_choices.hpp"
#include "programs/functions.hpp"
#include "programs/variables.hpp"
#include "support/files.hpp"

namespace jourdain::emit {

/// What the files say about a model beside its programs.
struct ModelText {
  ir::TextChoices choices;
  std::string name;   ///< namespace and file name
  std::string title;  ///< the model's own name
  std::string description;
  std::string numbers_from;                 ///< source of the model's numbers
  std::string path;                         ///< relative path of the description
  std::string sha256;                       ///< of the description
  std::vector<support::FileHash> imported;  ///< files that it imports
  std::vector<std::string> options;         ///< of the command line
  programs::SceneFacts facts;
  std::vector<programs::Variable> variables;
  std::vector<std::string> loops;  ///< sentences on how loops are closed
  double least_regularity = 0,
         greatest_opening = 0;     ///< limits of State's members of these names; with loops
  bool opening_is_proven = false;  ///< its limit follows from a proof
  bool searches = false;           ///< points that touch ground of a height
  loops::ProvenBox proven;  ///< for which positions and parameters the closing of loops is; empty: nothing is
  std::vector<std::string> assumptions;  ///< sentences
  std::vector<std::string> left_out;     ///< sentences
  std::vector<std::string> validation;   ///< sentences
  double backward_error = 0;             ///< of M zdot = k_bar − q_bar, worst over the sampled states
  double condition = 0;                  ///< cond(M), worst over the sampled states
};

using File = support::FileText;

inline constexpr const char* kVersion = "0.1.0";

}  // namespace jourdain::emit
