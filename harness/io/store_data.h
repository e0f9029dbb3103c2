#pragma once
// Plain data into HDF5, as its JSON describes it (io/data_json.h): no second list of members.

#include <nlohmann/json_fwd.hpp>

#include "harness/io/hdf5.h"

namespace ddem::harness {

/// Members of an object: numbers and texts are attributes, lists of them datasets, objects groups ('/' in a name becomes ':').
/// A list of objects that are alike is a group of columns, one dataset a member, with a row an object; others are groups by
/// their place, "0000". A matrix is one dataset. What is null is no number: NAME_status says "none" (in columns: an entry a
/// row). Empty texts, lists and objects are left out.
void store_data(Hdf5Group& group, const nlohmann::json& data);

}  // namespace ddem::harness
