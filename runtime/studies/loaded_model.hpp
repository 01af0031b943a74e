// SPDX-License-Identifier: MIT
// An emitted model loaded from a shared object through its table of C functions.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "jourdain/model_table.h"

namespace jourdain::studies {

/// Keeps the shared object loaded for as long as it lives.
class LoadedModel {
 public:
  /// Throws EnvironmentError naming the path when the object cannot be loaded or has no `jourdain_shim_table`.
  explicit LoadedModel(const std::string& path);

  const jourdain_model_table& table() const { return *table_; }

 private:
  struct Close {
    void operator()(void* handle) const;
  };
  std::unique_ptr<void, Close> handle_;
  const jourdain_model_table* table_ = nullptr;
};

/// From now on the model has these values of its parameters, in the mechanism's order.
void set_parameters(const jourdain_model_table& table, const std::vector<double>& values);

}  // namespace jourdain::studies
