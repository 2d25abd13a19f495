// Whether this build has a sanitizer, which takes more memory than there is and reports crashes itself.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define GEM_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define GEM_SANITIZED 1
#endif
#endif

namespace gem {

#ifdef GEM_SANITIZED
inline constexpr bool is_sanitized = true;
#undef GEM_SANITIZED
#else
inline constexpr bool is_sanitized = false;
#endif

}  // namespace gem
