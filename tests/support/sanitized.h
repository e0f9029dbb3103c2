#pragma once
// Whether the sanitizers watch: they take memory of their own, and what they are to see shows in few steps.

namespace ddem::test {

#if defined(DDEM_SANITIZED)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

}  // namespace ddem::test
