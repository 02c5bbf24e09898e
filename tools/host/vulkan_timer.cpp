#include "host/vulkan_timer.hpp"

namespace ao::host {
result<vulkan_timer> vulkan_timer::create(vulkan_device& device, uint32_t marks)
{
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device.physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device.physical, &count, families.data());
    const uint32_t bits = families[device.queue_family].timestampValidBits;
    if (bits == 0)
        return failure{ "the Vulkan device \"" + std::string(device.name()) + "\" has no time stamps" };

    vulkan_timer self;
    self.device_ = device.device;
    self.marks_ = marks;
    self.mask_ = bits >= 64 ? ~uint64_t{ 0 } : (uint64_t{ 1 } << bits) - 1;
    self.period_ns_ = static_cast<double>(device.properties.limits.timestampPeriod);
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = marks;
    if (const VkResult code = vkCreateQueryPool(device.device, &info, nullptr, &self.pool_); code != VK_SUCCESS)
        return failure{ "vkCreateQueryPool failed with VkResult " + std::to_string(code) };
    return self;
}

vulkan_timer& vulkan_timer::operator=(vulkan_timer&& other) noexcept
{
    std::swap(device_, other.device_);
    std::swap(pool_, other.pool_);
    marks_ = other.marks_;
    next_ = other.next_;
    mask_ = other.mask_;
    period_ns_ = other.period_ns_;
    return *this;
}

vulkan_timer::~vulkan_timer()
{
    if (device_)
        vkDestroyQueryPool(device_, pool_, nullptr);
}

void vulkan_timer::record_reset(VkCommandBuffer commands)
{
    vkCmdResetQueryPool(commands, pool_, 0, marks_);
    next_ = 0;
}

void vulkan_timer::record_mark(VkCommandBuffer commands)
{
    if (next_ < marks_)
        vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool_, next_++);
}

result<std::vector<double>> vulkan_timer::read() const
{
    if (next_ < 2)
        return failure{ "a timer with fewer than two marks" };
    std::vector<uint64_t> ticks(next_);
    const VkResult code = vkGetQueryPoolResults(device_, pool_, 0, next_, ticks.size() * sizeof(uint64_t), ticks.data(),
                                                sizeof(uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
    if (code != VK_SUCCESS)
        return failure{ "vkGetQueryPoolResults failed with VkResult " + std::to_string(code) };
    std::vector<double> milliseconds;
    for (std::size_t i = 1; i < ticks.size(); ++i)
        milliseconds.push_back(static_cast<double>((ticks[i] - ticks[i - 1]) & mask_) * period_ns_ * 1e-6);
    return milliseconds;
}
}
