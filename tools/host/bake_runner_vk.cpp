#include "ao/vk/bake.hpp"
#include "host/bake_runner_of.hpp"
#include "host/runner.hpp"
#include "host/vulkan_device.hpp"

#include <memory>

namespace ao::host {

ao::result<bake_runner_ptr> make_vk_bake_runner(const bake_runner_options& o)
{
    auto device = vulkan_device::create({ .device = o.device });
    if (!device) {
        return error(errc::device, device.reason());
    }
    auto baker = vk::baker::create(vk_context_of(**device), { (*device)->queue, (*device)->queue_family });
    if (!baker) {
        return baker.error();
    }
    std::string name((*device)->name());
    using made = bake_runner_of<std::unique_ptr<vulkan_device>, vk::baker>;
    return bake_runner_ptr(std::make_unique<made>("vk", std::move(name), std::move(*device), std::move(*baker)));
}

} // namespace ao::host
