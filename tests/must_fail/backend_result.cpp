// prepare() answers with a result: errors are values, not null pointers.
#include <ao/backend.hpp>

struct nearly {
    using image = int;
    struct commands {};
    struct program {};
    struct binding {};
#ifdef AO_MISUSE
    program* prepare(const ao::plan&)
    {
        return nullptr;
    }
#else
    ao::result<program> prepare(const ao::plan&)
    {
        return program{};
    }
#endif
    ao::result<binding> bind(program&, const ao::plan&, const ao::host_images<int>&)
    {
        return binding{};
    }
    void record_pass(commands, program&, binding&, const ao::plan&, std::size_t) {}
};

using effect = ao::effect<nearly>;
