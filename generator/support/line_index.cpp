#include "support/line_index.hpp"

#include <algorithm>

#include "support/utf8.hpp"

namespace jourdain::support {

namespace {

int characters(std::string_view text, bool ascii) {
  if (ascii) return static_cast<int>(text.size());
  int count = 0;
  for (std::size_t i = 0; i < text.size(); i += utf8_at(text, i).bytes) ++count;
  return count;
}

}  // namespace

LineIndex::LineIndex(std::string_view text) : text_(text), starts_{0} {
  ascii_ = std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  for (auto i = text.find('\n'); i != std::string_view::npos; i = text.find('\n', i + 1))
    starts_.push_back(i + 1);
}

SourceRange LineIndex::range(std::size_t offset, std::size_t length) const {
  const auto after = std::upper_bound(starts_.begin(), starts_.end(), offset);
  const int number = static_cast<int>(after - starts_.begin());
  const std::size_t start = *(after - 1);
  const std::string_view bytes = line(number);
  const std::size_t begin = std::min(offset - start, bytes.size());
  return {number, 1 + characters(bytes.substr(0, begin), ascii_),
          std::max(1, characters(bytes.substr(begin, length), ascii_))};
}

std::string_view LineIndex::line(int number) const {
  if (number < 1 || static_cast<std::size_t>(number) > starts_.size()) return {};
  const auto index = static_cast<std::size_t>(number) - 1;
  const std::size_t end = index + 1 < starts_.size() ? starts_[index + 1] - 1 : text_.size();
  std::string_view bytes = text_.substr(starts_[index], end - starts_[index]);
  if (bytes.ends_with('\r')) bytes.remove_suffix(1);
  return bytes;
}

std::size_t LineIndex::offset(int number, int column) const {
  const std::string_view bytes = line(number);
  if (bytes.data() == nullptr) return text_.size();
  std::size_t i = ascii_ ? std::min(static_cast<std::size_t>(std::max(1, column) - 1), bytes.size()) : 0;
  for (int c = 1; !ascii_ && c < column && i < bytes.size(); ++c) i += utf8_at(bytes, i).bytes;
  return static_cast<std::size_t>(bytes.data() - text_.data()) + i;
}

}  // namespace jourdain::support
