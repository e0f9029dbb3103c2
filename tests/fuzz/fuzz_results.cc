// What runs leave behind: units (with a checksum that holds), baselines, summaries.
#include <string>

#include "harness/io/digest.h"
#include "harness/nightly/baseline.h"
#include "harness/nightly/summary.h"
#include "harness/nightly/unit_file.h"
#include "tests/fuzz/fuzz.h"

void fuzz(std::string_view text) {
  using namespace ddem::harness;
  const std::string bytes(text);
  refused_or_read([&] { nightly::parse_unit(bytes, "fuzz.unit"); });
  refused_or_read([&] { nightly::parse_unit("ddem unit 1 " + sha256(bytes) + "\n" + bytes, "fuzz.unit"); });
  refused_or_read([&] { nightly::parse_baseline(bytes, "fuzz.json"); });
  refused_or_read([&] { nightly::parse_summary(parse_json(bytes, "fuzz.json"), "fuzz.json"); });
}
