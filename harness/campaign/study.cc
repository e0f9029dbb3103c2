#include "harness/campaign/study.h"

#include <nlohmann/json.hpp>

namespace ddem::harness {

nlohmann::json Study::data() const {
  return nullptr;
}

}  // namespace ddem::harness
