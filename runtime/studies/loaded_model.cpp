// SPDX-License-Identifier: MIT
#include "studies/loaded_model.hpp"

#include <dlfcn.h>

#include "support/check.hpp"

namespace jourdain::studies {

namespace {

std::string last_error() {
  const char* text = dlerror();
  return text ? text : "unknown error";
}

}  // namespace

void LoadedModel::Close::operator()(void* handle) const { dlclose(handle); }

LoadedModel::LoadedModel(const std::string& path) : handle_(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (!handle_) throw support::EnvironmentError("cannot load '" + path + "': " + last_error());
  void* symbol = dlsym(handle_.get(), "jourdain_shim_table");
  if (!symbol) throw support::EnvironmentError("no model in '" + path + "': " + last_error());
  table_ = reinterpret_cast<const jourdain_model_table* (*)()>(symbol)();
}

void set_parameters(const jourdain_model_table& table, const std::vector<double>& values) {
  const auto parts = static_cast<std::size_t>(table.parts);
  std::vector<double> numbers(parts * values.size());
  for (std::size_t i = 0; i < values.size(); ++i) numbers[i * parts] = values[i];
  table.set_parameters(numbers.data());
}

}  // namespace jourdain::studies
