#include "host/vulkan_device.hpp"

#include "host/vulkan_messages.hpp"

#ifdef __SANITIZE_ADDRESS__
#include <dlfcn.h>
#endif

#include <algorithm>
#include <cctype>
#include <cstring>
#include <initializer_list>

namespace ao::host {
namespace {
constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

failure vulkan_failure(const char* what, VkResult code)
{
    return { std::string(what) + " failed with VkResult " + std::to_string(code) };
}

std::string lower(std::string_view text)
{
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(),
                   [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
    return out;
}

bool has_validation_layer()
{
    uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    return std::any_of(layers.begin(), layers.end(),
                       [](const VkLayerProperties& layer) { return std::strcmp(layer.layerName, validation_layer) == 0; });
}

// What a driver leaks is told from what we leak by the driver's name, which it loses when the loader unloads it.
void keep_driver_loaded([[maybe_unused]] VkDevice device)
{
#ifdef __SANITIZE_ADDRESS__
    Dl_info driver{};
    if (dladdr(reinterpret_cast<const void*>(vkGetDeviceProcAddr(device, "vkQueueSubmit")), &driver) != 0)
        dlopen(driver.dli_fname, RTLD_NOW | RTLD_NOLOAD | RTLD_NODELETE);
#endif
}

result<VkInstance> create_instance(vulkan_messages* messages)
{
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "ao";
    application.apiVersion = VK_API_VERSION_1_1;

    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;

    const char* extensions[] = { VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME };
    const VkValidationFeatureEnableEXT enabled[] = { VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT };
    VkValidationFeaturesEXT validation{};
    VkDebugUtilsMessengerCreateInfoEXT messenger{};
    if (messages) {
        if (!has_validation_layer())
            return failure{ std::string("no ") + validation_layer + " (install vulkan-validationlayers)" };
        messenger = messages->create_info();
        validation.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
        validation.enabledValidationFeatureCount = 1;
        validation.pEnabledValidationFeatures = enabled;
        validation.pNext = &messenger;
        info.pNext = &validation;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &validation_layer;
        info.enabledExtensionCount = 2;
        info.ppEnabledExtensionNames = extensions;
    }

    VkInstance instance = VK_NULL_HANDLE;
    const VkResult code = vkCreateInstance(&info, nullptr, &instance);
    if (code == VK_ERROR_INCOMPATIBLE_DRIVER)
        return failure{ "no Vulkan device: no driver was found (install mesa-vulkan-drivers)" };
    if (code != VK_SUCCESS)
        return vulkan_failure("no Vulkan device: vkCreateInstance", code);
    return instance;
}

struct candidate {
    VkPhysicalDevice device;
    VkPhysicalDeviceProperties properties;
};

std::vector<candidate> enumerate(VkInstance instance)
{
    uint32_t count = 0;
    if (vkEnumeratePhysicalDevices(instance, &count, nullptr) != VK_SUCCESS)
        return {};
    std::vector<VkPhysicalDevice> devices(count);
    vkEnumeratePhysicalDevices(instance, &count, devices.data());
    devices.resize(count);
    std::vector<candidate> out;
    for (const VkPhysicalDevice device : devices) {
        out.push_back({ device, {} });
        vkGetPhysicalDeviceProperties(device, &out.back().properties);
    }
    return out;
}

result<candidate> pick(const std::vector<candidate>& all, const std::string& wanted)
{
    if (all.empty())
        return failure{ "no Vulkan device: no driver offers one (install mesa-vulkan-drivers)" };
    const auto found = std::find_if(all.begin(), all.end(), [&](const candidate& c) {
        return wanted.empty() ? c.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU
                              : lower(c.properties.deviceName).find(lower(wanted)) != std::string::npos;
    });
    if (found == all.end() && !wanted.empty()) {
        std::string text = "no Vulkan device named \"" + wanted + "\"; there is ";
        for (std::size_t i = 0; i < all.size(); ++i)
            text += (i ? ", \"" : "\"") + std::string(all[i].properties.deviceName) + "\"";
        return failure{ std::move(text) };
    }
    const candidate& chosen = found == all.end() ? all.front() : *found;
    if (chosen.properties.apiVersion < VK_API_VERSION_1_1)
        return failure{ "the Vulkan device \"" + std::string(chosen.properties.deviceName) + "\" lacks Vulkan 1.1" };
    return chosen;
}

int find_queue_family(VkPhysicalDevice physical)
{
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    const VkQueueFlags wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (std::size_t i = 0; i < families.size(); ++i)
        if ((families[i].queueFlags & wanted) == wanted)
            return static_cast<int>(i);
    return -1;
}

VkPhysicalDeviceFeatures useful_features(VkPhysicalDevice physical, bool drawing)
{
    VkPhysicalDeviceFeatures has{};
    vkGetPhysicalDeviceFeatures(physical, &has);
    VkPhysicalDeviceFeatures on{};
    on.shaderStorageImageExtendedFormats = has.shaderStorageImageExtendedFormats;
    on.shaderStorageImageReadWithoutFormat = has.shaderStorageImageReadWithoutFormat;
    on.shaderStorageImageWriteWithoutFormat = has.shaderStorageImageWriteWithoutFormat;
    on.fragmentStoresAndAtomics = has.fragmentStoresAndAtomics;
    on.vertexPipelineStoresAndAtomics = has.vertexPipelineStoresAndAtomics;
    on.multiDrawIndirect = drawing && has.multiDrawIndirect;
    on.drawIndirectFirstInstance = drawing && has.drawIndirectFirstInstance;
    return on;
}

// Extensions to create a device with, and the features that go with them.
struct drawing_extensions {
    std::vector<const char*> names;
    VkPhysicalDeviceDynamicRenderingFeatures rendering{};
    VkPhysicalDeviceExtendedDynamicStateFeaturesEXT state{};

    // Whether the device has all of these and says that the feature in `of` is there.
    template <class Features>
    bool add(VkPhysicalDevice physical, const std::vector<VkExtensionProperties>& offered, Features& of, VkStructureType type,
             VkBool32 Features::*feature, std::initializer_list<const char*> wanted)
    {
        for (const char* name : wanted)
            if (std::none_of(offered.begin(), offered.end(),
                             [&](const VkExtensionProperties& e) { return std::strcmp(e.extensionName, name) == 0; }))
                return false;
        of.sType = type;
        VkPhysicalDeviceFeatures2 features{};
        features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
        features.pNext = &of;
        vkGetPhysicalDeviceFeatures2(physical, &features);
        if (!(of.*feature))
            return false;
        names.insert(names.end(), wanted.begin(), wanted.end());
        of.pNext = chain;
        chain = &of;
        return true;
    }
    void* chain = nullptr;
};

std::vector<VkExtensionProperties> offered_extensions(VkPhysicalDevice physical)
{
    uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> offered(count);
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, offered.data());
    return offered;
}
}

result<std::unique_ptr<vulkan_device>> vulkan_device::create(const vulkan_options& options)
{
    std::unique_ptr<vulkan_device> self(new vulkan_device);
    if (options.validation)
        self->messages_ = std::make_unique<vulkan_messages>();

    auto instance = create_instance(self->messages_.get());
    if (!instance)
        return failure{ instance.reason() };
    self->instance = *instance;
    if (self->messages_)
        self->messages_->attach(self->instance);

    const auto chosen = pick(enumerate(self->instance), options.device);
    if (!chosen)
        return failure{ chosen.reason() };
    self->physical = chosen->device;
    self->properties = chosen->properties;
    self->features = useful_features(self->physical, options.drawing_features);

    const int family = find_queue_family(self->physical);
    if (family < 0)
        return failure{ "the Vulkan device \"" + std::string(self->name()) + "\" has no queue for graphics and compute" };
    self->queue_family = static_cast<uint32_t>(family);

    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue_info{};
    queue_info.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue_info.queueFamilyIndex = self->queue_family;
    queue_info.queueCount = 1;
    queue_info.pQueuePriorities = &priority;
    VkDeviceCreateInfo device_info{};
    device_info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    device_info.queueCreateInfoCount = 1;
    device_info.pQueueCreateInfos = &queue_info;
    device_info.pEnabledFeatures = &self->features;
    drawing_extensions drawing;
    if (options.drawing_features) {
        const auto offered = offered_extensions(self->physical);
        self->dynamic_rendering =
            drawing.add(self->physical, offered, drawing.rendering, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES,
                        &VkPhysicalDeviceDynamicRenderingFeatures::dynamicRendering,
                        { VK_KHR_DYNAMIC_RENDERING_EXTENSION_NAME, VK_KHR_DEPTH_STENCIL_RESOLVE_EXTENSION_NAME,
                          VK_KHR_CREATE_RENDERPASS_2_EXTENSION_NAME });
        self->extended_dynamic_state = drawing.add(self->physical, offered, drawing.state,
                                                   VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTENDED_DYNAMIC_STATE_FEATURES_EXT,
                                                   &VkPhysicalDeviceExtendedDynamicStateFeaturesEXT::extendedDynamicState,
                                                   { VK_EXT_EXTENDED_DYNAMIC_STATE_EXTENSION_NAME });
    }
    device_info.pNext = drawing.chain;
    device_info.enabledExtensionCount = static_cast<uint32_t>(drawing.names.size());
    device_info.ppEnabledExtensionNames = drawing.names.data();
    if (const VkResult code = vkCreateDevice(self->physical, &device_info, nullptr, &self->device); code != VK_SUCCESS)
        return vulkan_failure("vkCreateDevice", code);
    keep_driver_loaded(self->device);
    vkGetDeviceQueue(self->device, self->queue_family, 0, &self->queue);

    VkCommandPoolCreateInfo pool_info{};
    pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool_info.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool_info.queueFamilyIndex = self->queue_family;
    if (const VkResult code = vkCreateCommandPool(self->device, &pool_info, nullptr, &self->pool_); code != VK_SUCCESS)
        return vulkan_failure("vkCreateCommandPool", code);
    return self;
}

vulkan_device::~vulkan_device()
{
    if (device) {
        vkDeviceWaitIdle(device);
        vkDestroyCommandPool(device, pool_, nullptr);
        vkDestroyDevice(device, nullptr);
    }
    if (messages_ && instance)
        messages_->detach(instance);
    if (instance)
        vkDestroyInstance(instance, nullptr);
}

std::vector<std::string> vulkan_device::messages() const
{
    return messages_ ? messages_->list() : std::vector<std::string>{};
}

result<done> vulkan_device::submit(const std::function<void(VkCommandBuffer)>& record)
{
    VkCommandBufferAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocate.commandPool = pool_;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkResult code = vkAllocateCommandBuffers(device, &allocate, &commands);
    if (code != VK_SUCCESS)
        return vulkan_failure("vkAllocateCommandBuffers", code);

    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    code = vkBeginCommandBuffer(commands, &begin);
    if (code == VK_SUCCESS) {
        record(commands);
        code = vkEndCommandBuffer(commands);
    }
    if (code == VK_SUCCESS) {
        VkSubmitInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        info.commandBufferCount = 1;
        info.pCommandBuffers = &commands;
        code = vkQueueSubmit(queue, 1, &info, VK_NULL_HANDLE);
    }
    if (code == VK_SUCCESS)
        code = vkQueueWaitIdle(queue);
    vkFreeCommandBuffers(device, pool_, 1, &commands);
    if (code != VK_SUCCESS)
        return vulkan_failure("submitting a command buffer", code);
    return done{};
}

int vulkan_device::memory_type(uint32_t allowed, VkMemoryPropertyFlags wanted) const
{
    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    for (uint32_t i = 0; i < memory.memoryTypeCount; ++i)
        if ((allowed & (1u << i)) && (memory.memoryTypes[i].propertyFlags & wanted) == wanted)
            return static_cast<int>(i);
    return -1;
}

result<std::vector<std::string>> vulkan_device_names()
{
    auto instance = create_instance(nullptr);
    if (!instance)
        return failure{ instance.reason() };
    std::vector<std::string> names;
    for (const candidate& c : enumerate(*instance))
        names.emplace_back(c.properties.deviceName);
    vkDestroyInstance(*instance, nullptr);
    return names;
}
}
