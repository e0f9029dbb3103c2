#pragma once
// All that a campaign knows of its studies. A study is a folder of harness/studies and a line of registry.cc.

#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <typeindex>
#include <vector>

#include "harness/campaign/run_options.h"
#include "harness/nightly/history.h"
#include "harness/nightly/unit.h"
#include "reports/report.h"
#include "reports/verdict.h"

namespace ddem::harness {

/// A unit of work, and where its outcome goes. Both may be called once, and not at the same time as those of other units.
struct Piece {
  nightly::Unit unit;
  std::function<void(const nlohmann::json& result)> take;  ///< throws on a result of another shape
  std::function<void(const std::string& reason)> miss;     ///< why there is no result
};

/// A case, and the units that it follows from: its own study's and others'.
struct Judged {
  reports::Verdict verdict;
  std::vector<std::string> units;
};

/// Made anew for every run or reading of a campaign. What it has not been given yet is missing, with a reason: judge() and
/// sections() do not throw for it.
class Study {
 public:
  Study() = default;
  Study(const Study&) = delete;
  Study& operator=(const Study&) = delete;
  virtual ~Study() = default;

  /// Units do not need each other; their names are unique in the campaign.
  const std::vector<Piece>& pieces() const { return pieces_; }
  /// Always the same cases with the same units, whatever was found; a case's name begins with what is checked.
  virtual std::vector<Judged> judge() const { return {}; }
  /// For the report; sections of one heading, of several studies, become one.
  virtual std::vector<reports::Section> sections() const { return {}; }
  /// Findings (a sentence each), headlines and provenance: what the report opens and ends with.
  virtual void introduce(reports::Report&) const {}
  /// For results.h5: an object (io/store_data.h), or null.
  virtual nlohmann::json data() const;
  /// Adds how much was computed.
  virtual void count(nightly::WorkCounts&) const {}

 protected:
  std::vector<Piece> pieces_;
};

/// What studies of a campaign have in common, made by whichever asks first.
class SharedObjects {
 public:
  template <class T, class Make>
  std::shared_ptr<T> get(const Make& make) {
    std::shared_ptr<void>& slot = objects_[typeid(T)];
    if (!slot) slot = std::shared_ptr<T>(make());
    return std::static_pointer_cast<T>(slot);
  }

 private:
  std::map<std::type_index, std::shared_ptr<void>> objects_;
};

/// What a study is made from.
struct StudyContext {
  const nlohmann::json& tables;       ///< the campaign's, by name: see InputTable
  std::span<const std::string> only;  ///< the cases that are judged; empty: all
  const CampaignOptions& options;
  SharedObjects& shared;
};

}  // namespace ddem::harness
