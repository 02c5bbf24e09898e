#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>

#if defined(__SANITIZE_ADDRESS__)
#define AO_KEEP_LIBRARIES
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define AO_KEEP_LIBRARIES
#endif
#endif

#ifdef AO_KEEP_LIBRARIES
// The Vulkan loader unloads drivers; their leaks could then not be told from ours by the name of a library.
extern "C" int dlclose(void*)
{
    return 0;
}
#endif
