#pragma once
// The reference of scene files, written from the table that the reader uses.

#include <string>

namespace ddem::harness {

/// Markdown: a section a table, a row a key. harness/guide/scene.md is this text.
std::string scene_reference();

}  // namespace ddem::harness
