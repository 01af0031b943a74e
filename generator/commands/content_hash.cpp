#include "commands/content_hash.hpp"

#include <fmt/format.h>
#include <nettle/sha2.h>

#include <array>
#include <fstream>
#include <vector>

#include "support/check.hpp"

namespace jourdain::commands {

namespace {

std::string digest_of(sha256_ctx& context) {
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
  sha256_digest(&context, digest.size(), digest.data());
  std::string hex;
  for (std::uint8_t byte : digest) hex += fmt::format("{:02x}", byte);
  return hex;
}

void update(sha256_ctx& context, std::string_view text) {
  sha256_update(&context, text.size(), reinterpret_cast<const std::uint8_t*>(text.data()));
}

}  // namespace

std::string sha256_of(std::string_view text) {
  sha256_ctx context;
  sha256_init(&context);
  update(context, text);
  return digest_of(context);
}

std::string sha256_of_file(const std::string& path, std::uint64_t skipped) {
  sha256_ctx context;
  sha256_init(&context);
  std::ifstream in(path, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(skipped));
  std::vector<char> block(std::size_t(1) << 20);
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0)
    update(context, {block.data(), static_cast<std::size_t>(in.gcount())});
  if (!in.eof()) throw support::EnvironmentError(path + ": cannot be read");
  return digest_of(context);
}

}  // namespace jourdain::commands
