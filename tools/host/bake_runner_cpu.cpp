#include "ao/cpu/bake.hpp"
#include "host/bake_runner_of.hpp"

#include <cstddef>
#include <memory>

namespace ao::host {

ao::result<bake_runner_ptr> make_cpu_bake_runner(const bake_runner_options& o)
{
    const cpu::width lanes = o.lanes == 1    ? cpu::width::scalar
                             : o.lanes == 4  ? cpu::width::lanes4
                             : o.lanes == 8  ? cpu::width::lanes8
                             : o.lanes == 16 ? cpu::width::lanes16
                                             : cpu::width::automatic;
    auto baker = cpu::baker::create({ .lanes = lanes, .threads = o.threads });
    if (!baker) {
        return baker.error();
    }
    const int threads = baker->threads();
    std::string name(cpu::name_of(baker->lanes()));
    name += ", " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
    using made = bake_runner_of<std::nullptr_t, cpu::baker>;
    return bake_runner_ptr(std::make_unique<made>("cpu", std::move(name), nullptr, std::move(*baker)));
}

} // namespace ao::host
