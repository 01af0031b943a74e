#include "readback/c_known_text.hpp"

#include <array>

#include "readback/function_texts.hpp"

namespace jourdain::readback {

namespace {

constexpr std::array<CPassage, 17> kPassages = {{
    {"time", R"(typedef struct {
  @R@ high, low, rest;
} @N@time;

@N@time @N@time_at(@R@ t);

@N@time @N@time_after(@N@time t, @R@ h);
)"},
    {"input_at", R"(typedef void (*@N@input_at)(void *context, const @N@state *state, @N@input *input);
)"},
    {"time_at", R"(@N@time @N@time_at(@R@ t) {
  @N@time made;

  made.high = t;
  made.low = 0.0@F@;
  made.rest = 0.0@F@;
  return made;
}
)"},
    {"time_after", R"(@N@time @N@time_after(@N@time t, @R@ h) {
  @N@time later;
  const @R@ step = h + t.rest;
  const @R@ low = t.low + step;

  later.rest = step - (low - t.low);
  later.high = t.high + low;
  later.low = low - (later.high - t.high);
  return later;
}
)"},
    {"product_error", R"(static @R@ @D@product_error(@R@ a, @R@ b, @R@ product) {
  const @R@ more = a * @S@, much = b * @S@;
  const @R@ a1 = (more + a) - more, b1 = (much + b) - much;
  const @R@ a0 = a - a1, b0 = b - b1;

  return ((a1 * b1 - product) + a1 * b0 + a0 * b1) + a0 * b0;
}
)"},
    {"angle", R"(typedef struct {
  @R@ high, low;
} @D@angle;
)"},
    {"angle_of", R"(static @D@angle @D@angle_of(@R@ value) {
  @D@angle made;

  made.high = value;
  made.low = 0.0@F@;
  return made;
}
)"},
    {"angle_of_time", R"(static @D@angle @D@angle_of_time(@N@time t) {
  @D@angle made;

  made.high = t.high;
  made.low = t.low;
  return made;
}
)"},
    {"angle_of_parts", R"(static @D@angle @D@angle_of_parts(@R@ a, @R@ b) {
  @D@angle made;
  @R@ part;

  made.high = a + b;
  part = made.high - a;
  made.low = (a - (made.high - part)) + (b - part);
  return made;
}
)"},
    {"angle_negative", R"(static @D@angle @D@angle_negative(@D@angle a) {
  return @D@angle_of_parts(-a.high, -a.low);
}
)"},
    {"angle_sum", R"(static @D@angle @D@angle_sum(@D@angle a, @D@angle b) {
  const @D@angle sum = @D@angle_of_parts(a.high, b.high);

  return @D@angle_of_parts(sum.high, sum.low + (a.low + b.low));
}
)"},
    {"angle_difference", R"(static @D@angle @D@angle_difference(@D@angle a, @D@angle b) {
  return @D@angle_sum(a, @D@angle_negative(b));
}
)"},
    {"angle_product", R"(static @D@angle @D@angle_product(@D@angle a, @D@angle b) {
  const @R@ product = a.high * b.high;

  return @D@angle_of_parts(
      product, @D@product_error(a.high, b.high, product) + (a.high * b.low + a.low * b.high));
}
)"},
    {"angle_quotient", R"(static @D@angle @D@angle_quotient(@D@angle a, @D@angle b) {
  const @R@ quotient = a.high / b.high, product = quotient * b.high;
  const @R@ rest = (a.high - product) - @D@product_error(quotient, b.high, product);

  return @D@angle_of_parts(quotient, (rest + (a.low - quotient * b.low)) / b.high);
}
)"},
    {"angle_sine_cosine", R"(static void @D@angle_sine_cosine(@D@angle x, @R@ *s, @R@ *c) {
  @R@ s0, c0, s1, c1;

  @D@sine_cosine(x.high, &s0, &c0);
  @D@sine_cosine(x.low, &s1, &c1);
  *s = s0 * c1 + c0 * s1;
  *c = c0 * c1 - s0 * s1;
}
)"},
    {"angle_sine", R"(static @R@ @D@angle_sine(@D@angle x) {
  @R@ s, c;

  @D@angle_sine_cosine(x, &s, &c);
  return s;
}
)"},
    {"angle_cosine", R"(static @R@ @D@angle_cosine(@D@angle x) {
  @R@ s, c;

  @D@angle_sine_cosine(x, &s, &c);
  return c;
}
)"},
}};

}  // namespace

std::string CKnownTexts::filled(const std::string& text, const CText& c) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '@') {
      result += text[i];
      continue;
    }
    const char hole = text[i + 1];
    i += 2;
    if (hole == 'N') result += c.prefix;
    if (hole == 'D') result += c.internal();
    if (hole == 'R') result += c.real();
    if (hole == 'F') result += c.is_float ? "f" : "";
    if (hole == 'S') result += c.is_float ? "4096.0f" : "134217728.0";
  }
  return result;
}

const std::deque<CKnownText>& CKnownTexts::all() const { return texts_; }

CKnownTexts::CKnownTexts(const CText& c) {
  for (const CPassage& passage : kPassages) add(passage, c);
  add_own_sines(c);
  for (const ChoosingText& text : choosing_texts()) {
    CKnownText& made = add({text.name, text.c}, c);
    made.meaning_text = filled(text.c_meaning, c);
    made.meaning = tokenize(made.name, made.meaning_text);
  }
}

CKnownText& CKnownTexts::add(const CPassage& passage, const CText& c) {
  CKnownText& made = texts_.emplace_back();
  made.name = passage.name;
  made.text = filled(passage.text, c);
  made.tokens = tokenize(made.name, made.text);
  return made;
}

}  // namespace jourdain::readback
