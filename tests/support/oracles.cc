#include "tests/support/oracles.h"

namespace ddem::test {

const char* const kOracles = DDEM_ORACLES;

}  // namespace ddem::test
