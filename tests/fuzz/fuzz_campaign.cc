// Campaign files.
#include "harness/campaign/read_campaign.h"
#include "harness/io/errors.h"
#include "tests/fuzz/fuzz.h"

void fuzz(std::string_view text) {
  using namespace ddem::harness;
  try {
    parse_campaign(text, "/nowhere/fuzz.toml");
  } catch (const InputError& e) {
    require(!e.messages().empty());
  }
}
