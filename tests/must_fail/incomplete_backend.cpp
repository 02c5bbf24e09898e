// A type without bind() is no backend.
#include <ao/backend.hpp>

struct nearly {
    using image = int;
    struct commands {};
    struct program {};
    struct binding {};
    ao::result<program> prepare(const ao::plan&) { return program{}; }
#ifndef AO_MISUSE
    ao::result<binding> bind(program&, const ao::plan&, const ao::host_images<int>&)
    {
        return binding{};
    }
#endif
    void record_pass(commands, program&, binding&, const ao::plan&, std::size_t) {}
};

using effect = ao::effect<nearly>;
