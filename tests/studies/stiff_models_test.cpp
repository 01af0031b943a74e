// Stiff models: the limits that are predicted against the ones that runs show, and what the implicit steppers do beyond.
#include <fmt/format.h>

#include <cmath>

#include "studies/judged.hpp"

namespace jourdain::tests {
namespace {

TEST(Explore, Limits) {
  struct Case { const char* model; const char* parameter; std::vector<double> values; double duration; bool conserves; };
  for (const Case& c : {Case{"spring_pendulum","k",{1e2,1e4,1e6,1e8,1e10,1e12},1,true}, Case{"elastic_arm","k",{1e3,1e6,1e9},1,false}, Case{"contact_wheel","k",{1e6,1e7,1e8},1,false}, Case{"spring_joint","k",{1e4,1e6,1e8,1e10},1,false}}) {
    for (double v : c.values) {
      EmittedModel m = emitted_model(c.model);
      m.set_parameter(c.parameter, v);
      const Judged j(std::move(m), 32, c.conserves, c.duration/32);
      for (const char* method : {"euler","rk4"}) { const MethodLimit& l = j.limit(method);
        fmt::print("{} {}={:g} {}: predicted {:.4g} observed {:.4g} mode {:.4g}{:+.4g}i kind {} fast {}\n", c.model,c.parameter,v,method,l.h,l.observed?l.observed->h:0.0,l.mode.real(),l.mode.imag(),int(l.kind),l.fast); }
    }
  }
}

}  // namespace
}  // namespace jourdain::tests
