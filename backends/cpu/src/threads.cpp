#include "threads.hpp"

#include <oneapi/tbb/global_control.h>

namespace ao::cpu::detail {

result<std::unique_ptr<threads>> make_threads(const options& o)
{
    if (o.threads < 0 || o.tile_width < 0 || o.tile_height < 0) {
        return error(errc::invalid_settings, "threads and tile size must not be negative");
    }
    try {
        // Asked for more than it allows, oneTBB would print a warning and start what it allows.
        using control = oneapi::tbb::global_control;
        const auto allowed = static_cast<int>(control::active_value(control::max_allowed_parallelism));
        const int count = o.threads == 0 ? allowed : std::min(o.threads, allowed);
        auto made =
            std::make_unique<threads>(count, o.tile_width > 0 ? o.tile_width : 64, o.tile_height > 0 ? o.tile_height : 64);
        made->arena.initialize();
        return made;
    } catch (...) {
        return error(errc::out_of_memory, "oneTBB could not start its threads");
    }
}

} // namespace ao::cpu::detail
