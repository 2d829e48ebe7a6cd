#include "gpu.h"
#include "fail.h"
#include "file.h"
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <vulkan/vulkan.h>

struct gpu {
    VkInstance instance;
    VkPhysicalDevice physical;
    VkDevice device;
    VkQueue queue;
    uint32_t family;
    uint64_t time_mask; /* the bits that a time stamp has */
    VkCommandPool pool;
    VkCommandBuffer commands;
    VkQueryPool queries; /* one time stamp before and one after */
    VkPhysicalDeviceMemoryProperties memory;
    VkPhysicalDeviceProperties properties;
};

struct gpu_buffer {
    gpu *device;
    gpu_kind kind;
    size_t size;
    VkBuffer buffer;
    VkDeviceMemory memory;
};

struct gpu_program {
    gpu *device;
    int count;
    gpu_kind kinds[GPU_MAX_BUFFERS];
    VkDescriptorSetLayout set_layout;
    VkDescriptorPool pool;
    VkDescriptorSet set;
    VkPipelineLayout layout;
    VkPipeline pipeline;
};

static const VkFormat picture_format = VK_FORMAT_R32G32B32A32_SFLOAT;

static void must(VkResult result, const char *what) {
    char why[64];
    if (result == VK_SUCCESS) return;
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) give_up(what, "no driver of a device was found");
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY) give_up(what, "not enough memory on the device");
    if (result == VK_ERROR_DEVICE_LOST) give_up(what, "the device was lost, as when work takes it too long");
    snprintf(why, sizeof why, "Vulkan's error %d", (int)result);
    give_up(what, why);
}

/* ---- device ---- */

/* Its index, or -1 if there is none */
static int find_queue_family(VkPhysicalDevice physical, uint32_t *time_bits) {
    const VkQueueFlags wanted = VK_QUEUE_COMPUTE_BIT | VK_QUEUE_GRAPHICS_BIT;
    VkQueueFamilyProperties families[16];
    uint32_t count = 16, i;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families);
    for (i = 0; i < count; i++) {
        *time_bits = families[i].timestampValidBits;
        if ((families[i].queueFlags & wanted) == wanted && *time_bits) return (int)i;
    }
    return -1;
}

static void choose_device(gpu *g, const char *name) {
    VkPhysicalDevice devices[16];
    uint32_t count = 16, time_bits, i;
    int best = -1, family;
    VkResult result = vkEnumeratePhysicalDevices(g->instance, &count, devices);
    if (result != VK_INCOMPLETE) must(result, "list of Vulkan devices");
    for (i = 0; i < count; i++) {
        VkPhysicalDeviceProperties p;
        int rank;
        vkGetPhysicalDeviceProperties(devices[i], &p);
        rank = p.deviceType == VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU ? 2 : p.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU;
        if (rank <= best || !strstr(p.deviceName, name) || p.apiVersion < VK_API_VERSION_1_3) continue;
        family = find_queue_family(devices[i], &time_bits);
        if (family < 0) continue;
        best = rank;
        g->physical = devices[i];
        g->properties = p;
        g->family = (uint32_t)family;
        g->time_mask = ~(uint64_t)0 >> (64 - time_bits);
    }
    if (best < 0 && *name) give_up(name, "no device of Vulkan 1.3 has that in its name");
    if (best < 0) give_up("GPU", "no device of Vulkan 1.3");
}

gpu *gpu_open(const char *name) {
    gpu *g = allocate("GPU", 1, sizeof *g);
    VkApplicationInfo application = {0};
    VkInstanceCreateInfo instance = {0};
    VkPhysicalDeviceVulkan13Features features = {0};
    VkDeviceQueueCreateInfo queue = {0};
    VkDeviceCreateInfo device = {0};
    VkCommandPoolCreateInfo pool = {0};
    VkCommandBufferAllocateInfo commands = {0};
    VkQueryPoolCreateInfo queries = {0};
    const float priority = 1;
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.apiVersion = VK_API_VERSION_1_3;
    instance.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    instance.pApplicationInfo = &application;
    must(vkCreateInstance(&instance, NULL, &g->instance), "Vulkan");
    choose_device(g, name);
    vkGetPhysicalDeviceMemoryProperties(g->physical, &g->memory);
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = g->family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    features.dynamicRendering = VK_TRUE;
    device.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    device.pNext = &features;
    device.queueCreateInfoCount = 1;
    device.pQueueCreateInfos = &queue;
    must(vkCreateDevice(g->physical, &device, NULL, &g->device), g->properties.deviceName);
    vkGetDeviceQueue(g->device, queue.queueFamilyIndex, 0, &g->queue);
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = g->family;
    must(vkCreateCommandPool(g->device, &pool, NULL, &g->pool), "command pool");
    commands.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    commands.commandPool = g->pool;
    commands.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    commands.commandBufferCount = 1;
    must(vkAllocateCommandBuffers(g->device, &commands, &g->commands), "command buffer");
    queries.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
    queries.queryCount = 2;
    must(vkCreateQueryPool(g->device, &queries, NULL, &g->queries), "time stamps");
    return g;
}

const char *gpu_name(const gpu *device) {
    return device->properties.deviceName;
}

void gpu_close(gpu *g) {
    vkDestroyQueryPool(g->device, g->queries, NULL);
    vkDestroyCommandPool(g->device, g->pool, NULL);
    vkDestroyDevice(g->device, NULL);
    vkDestroyInstance(g->instance, NULL);
    free(g);
}

/* ---- commands ---- */

static void commands_begin(gpu *g) {
    VkCommandBufferBeginInfo begin = {0};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    must(vkBeginCommandBuffer(g->commands, &begin), "command buffer");
}

/* What was written is there for the commands to come, and for the CPU. */
static void commands_separate(gpu *g) {
    VkMemoryBarrier barrier = {0};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT | VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(g->commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, NULL, 0,
                         NULL);
}

static void commands_finish(gpu *g) {
    VkSubmitInfo submit = {0};
    commands_separate(g);
    must(vkEndCommandBuffer(g->commands), "command buffer");
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &g->commands;
    must(vkQueueSubmit(g->queue, 1, &submit, VK_NULL_HANDLE), g->properties.deviceName);
    must(vkQueueWaitIdle(g->queue), g->properties.deviceName);
}

/* The barrier is for Mesa's llvmpipe: without it the stamp may be that of a later moment. */
static void time_begin(gpu *g) {
    vkCmdResetQueryPool(g->commands, g->queries, 0, 2);
    vkCmdWriteTimestamp(g->commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, g->queries, 0);
    commands_separate(g);
}

static double time_finish(gpu *g) {
    uint64_t ticks[2];
    vkCmdWriteTimestamp(g->commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, g->queries, 1);
    commands_finish(g);
    must(vkGetQueryPoolResults(g->device, g->queries, 0, 2, sizeof ticks, ticks, sizeof *ticks,
                               VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
         "time stamps");
    return (double)((ticks[1] - ticks[0]) & g->time_mask) * (double)g->properties.limits.timestampPeriod * 1e-6;
}

/* ---- memory ---- */

static VkDeviceMemory memory_create(gpu *g, const VkMemoryRequirements *needs, VkMemoryPropertyFlags flags) {
    VkMemoryAllocateInfo info = {0};
    VkDeviceMemory memory;
    uint32_t i = 0;
    while (i < g->memory.memoryTypeCount &&
           !(needs->memoryTypeBits >> i & 1 && (g->memory.memoryTypes[i].propertyFlags & flags) == flags))
        i++;
    if (i == g->memory.memoryTypeCount) give_up(g->properties.deviceName, "has no such memory");
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = needs->size;
    info.memoryTypeIndex = i;
    must(vkAllocateMemory(g->device, &info, NULL, &memory), "memory of the GPU");
    return memory;
}

static gpu_buffer buffer_of(gpu *g, size_t size, VkBufferUsageFlags usage, VkMemoryPropertyFlags flags) {
    gpu_buffer b = {0};
    VkBufferCreateInfo info = {0};
    VkMemoryRequirements needs;
    b.device = g;
    b.size = size;
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = size;
    info.usage = usage;
    must(vkCreateBuffer(g->device, &info, NULL, &b.buffer), "buffer");
    vkGetBufferMemoryRequirements(g->device, b.buffer, &needs);
    b.memory = memory_create(g, &needs, flags);
    must(vkBindBufferMemory(g->device, b.buffer, b.memory, 0), "buffer");
    return b;
}

static void buffer_release(gpu_buffer *b) {
    vkDestroyBuffer(b->device->device, b->buffer, NULL);
    vkFreeMemory(b->device->device, b->memory, NULL);
}

/* A buffer that the CPU writes or reads, on the way to or from the device's own memory */
static gpu_buffer staging_of(gpu *g, size_t size) {
    return buffer_of(g, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                     VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
}

static void *staging_map(gpu_buffer *staging) {
    void *mapped;
    must(vkMapMemory(staging->device->device, staging->memory, 0, VK_WHOLE_SIZE, 0, &mapped), "memory of the GPU");
    return mapped;
}

gpu_buffer *gpu_buffer_create(gpu *device, gpu_kind kind, size_t size) {
    gpu_buffer *b = allocate("buffer", 1, sizeof *b);
    VkBufferUsageFlags usage =
        kind == GPU_UNIFORM ? VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT : VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    const VkPhysicalDeviceLimits *limits = &device->properties.limits;
    if (size > (kind == GPU_UNIFORM ? limits->maxUniformBufferRange : limits->maxStorageBufferRange))
        give_up(device->properties.deviceName, "takes no buffer as large as this work needs");
    *b = buffer_of(device, size, usage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                   VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    b->kind = kind;
    return b;
}

static void copy(gpu *g, VkBuffer from, VkBuffer to, size_t size) {
    VkBufferCopy region = {0};
    region.size = size;
    commands_begin(g);
    vkCmdCopyBuffer(g->commands, from, to, 1, &region);
    commands_finish(g);
}

void gpu_buffer_write(gpu_buffer *b, const void *values) {
    gpu_buffer staging = staging_of(b->device, b->size);
    memcpy(staging_map(&staging), values, b->size);
    copy(b->device, staging.buffer, b->buffer, b->size);
    buffer_release(&staging);
}

gpu_buffer *gpu_buffer_of(gpu *device, gpu_kind kind, const void *values, size_t size) {
    gpu_buffer *b = gpu_buffer_create(device, kind, size);
    gpu_buffer_write(b, values);
    return b;
}

void gpu_buffer_read(gpu_buffer *b, void *values) {
    gpu_buffer staging = staging_of(b->device, b->size);
    copy(b->device, b->buffer, staging.buffer, b->size);
    memcpy(values, staging_map(&staging), b->size);
    buffer_release(&staging);
}

void gpu_buffer_free(gpu_buffer *b) {
    buffer_release(b);
    free(b);
}

/* ---- programs ---- */

static VkShaderModule module_of(gpu *g, const char *folder, const char *name, const char *stage) {
    VkShaderModuleCreateInfo info = {0};
    VkShaderModule module;
    char path[1024];
    unsigned char *bytes;
    size_t count;
    uint32_t *words;
    const char *wrong;
    if (snprintf(path, sizeof path, "%s/%s.%s.spv", folder, name, stage) >= (int)sizeof path)
        give_up(folder, "too long a name");
    wrong = file_read(path, (size_t)1 << 26, &bytes, &count);
    if (wrong) give_up(path, wrong);
    words = allocate(path, count, 1); /* aligned */
    memcpy(words, bytes, count);
    free(bytes);
    if (count < sizeof *words || count % sizeof *words || *words != 0x07230203u) give_up(path, "not SPIR-V");
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = count;
    info.pCode = words;
    must(vkCreateShaderModule(g->device, &info, NULL, &module), path);
    free(words);
    return module;
}

static VkDescriptorType type_of(gpu_kind kind) {
    return kind == GPU_UNIFORM ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

/* All but the pipeline */
static gpu_program *program_of(gpu *g, const gpu_kind *kinds, int count, VkShaderStageFlags stage) {
    gpu_program *p = allocate("shader", 1, sizeof *p);
    VkDescriptorSetLayoutBinding bindings[GPU_MAX_BUFFERS];
    VkDescriptorSetLayoutCreateInfo set_layout = {0};
    VkDescriptorPoolSize sizes[2] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, GPU_MAX_BUFFERS},
                                     {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, GPU_MAX_BUFFERS}};
    VkDescriptorPoolCreateInfo pool = {0};
    VkDescriptorSetAllocateInfo set = {0};
    VkPipelineLayoutCreateInfo layout = {0};
    int i;
    p->device = g;
    p->count = count;
    memset(bindings, 0, sizeof bindings);
    for (i = 0; i < count; i++) {
        p->kinds[i] = kinds[i];
        bindings[i].binding = (uint32_t)i;
        bindings[i].descriptorType = type_of(kinds[i]);
        bindings[i].descriptorCount = 1;
        bindings[i].stageFlags = stage;
    }
    set_layout.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set_layout.bindingCount = (uint32_t)count;
    set_layout.pBindings = bindings;
    must(vkCreateDescriptorSetLayout(g->device, &set_layout, NULL, &p->set_layout), "bindings");
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1;
    pool.poolSizeCount = 2;
    pool.pPoolSizes = sizes;
    must(vkCreateDescriptorPool(g->device, &pool, NULL, &p->pool), "bindings");
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    set.descriptorPool = p->pool;
    set.descriptorSetCount = 1;
    set.pSetLayouts = &p->set_layout;
    must(vkAllocateDescriptorSets(g->device, &set, &p->set), "bindings");
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &p->set_layout;
    must(vkCreatePipelineLayout(g->device, &layout, NULL, &p->layout), "bindings");
    return p;
}

static VkPipelineShaderStageCreateInfo stage_of(VkShaderStageFlagBits stage, VkShaderModule module) {
    VkPipelineShaderStageCreateInfo info = {0};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage = stage;
    info.module = module;
    info.pName = "main";
    return info;
}

gpu_program *gpu_compute_create(gpu *device, const char *folder, const char *name, const gpu_kind *kinds, int count,
                                int constant) {
    gpu_program *p = program_of(device, kinds, count, VK_SHADER_STAGE_COMPUTE_BIT);
    VkShaderModule module = module_of(device, folder, name, "comp");
    VkSpecializationMapEntry entry = {0, 0, sizeof constant};
    VkSpecializationInfo special = {0};
    VkComputePipelineCreateInfo info = {0};
    special.mapEntryCount = 1;
    special.pMapEntries = &entry;
    special.dataSize = sizeof constant;
    special.pData = &constant;
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage = stage_of(VK_SHADER_STAGE_COMPUTE_BIT, module);
    info.stage.pSpecializationInfo = &special;
    info.layout = p->layout;
    must(vkCreateComputePipelines(device->device, VK_NULL_HANDLE, 1, &info, NULL, &p->pipeline), name);
    vkDestroyShaderModule(device->device, module, NULL);
    return p;
}

gpu_program *gpu_fragment_create(gpu *device, const char *folder, const char *name, const gpu_kind *kinds, int count) {
    gpu_program *p = program_of(device, kinds, count, VK_SHADER_STAGE_FRAGMENT_BIT);
    VkShaderModule modules[2];
    VkPipelineShaderStageCreateInfo stages[2];
    VkPipelineVertexInputStateCreateInfo vertices = {0};
    VkPipelineInputAssemblyStateCreateInfo assembly = {0};
    VkPipelineViewportStateCreateInfo viewport = {0};
    VkPipelineRasterizationStateCreateInfo raster = {0};
    VkPipelineMultisampleStateCreateInfo samples = {0};
    VkPipelineColorBlendAttachmentState attachment = {0};
    VkPipelineColorBlendStateCreateInfo blend = {0};
    VkDynamicState dynamic_states[2] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic = {0};
    VkPipelineRenderingCreateInfo rendering = {0};
    VkGraphicsPipelineCreateInfo info = {0};
    modules[0] = module_of(device, folder, "fullscreen", "vert");
    modules[1] = module_of(device, folder, name, "frag");
    stages[0] = stage_of(VK_SHADER_STAGE_VERTEX_BIT, modules[0]);
    stages[1] = stage_of(VK_SHADER_STAGE_FRAGMENT_BIT, modules[1]);
    vertices.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.polygonMode = VK_POLYGON_MODE_FILL;
    raster.lineWidth = 1;
    samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    attachment.colorWriteMask =
        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = 1;
    blend.pAttachments = &attachment;
    dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamic.dynamicStateCount = 2;
    dynamic.pDynamicStates = dynamic_states;
    rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
    rendering.colorAttachmentCount = 1;
    rendering.pColorAttachmentFormats = &picture_format;
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.pNext = &rendering;
    info.stageCount = 2;
    info.pStages = stages;
    info.pVertexInputState = &vertices;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = p->layout;
    must(vkCreateGraphicsPipelines(device->device, VK_NULL_HANDLE, 1, &info, NULL, &p->pipeline), name);
    vkDestroyShaderModule(device->device, modules[0], NULL);
    vkDestroyShaderModule(device->device, modules[1], NULL);
    return p;
}

void gpu_program_free(gpu_program *p) {
    VkDevice device = p->device->device;
    vkDestroyPipeline(device, p->pipeline, NULL);
    vkDestroyPipelineLayout(device, p->layout, NULL);
    vkDestroyDescriptorPool(device, p->pool, NULL);
    vkDestroyDescriptorSetLayout(device, p->set_layout, NULL);
    free(p);
}

static void program_bind(gpu_program *p, gpu_buffer *const *buffers, VkPipelineBindPoint point) {
    gpu *g = p->device;
    VkDescriptorBufferInfo infos[GPU_MAX_BUFFERS];
    VkWriteDescriptorSet writes[GPU_MAX_BUFFERS];
    int i;
    memset(writes, 0, sizeof writes);
    for (i = 0; i < p->count; i++) {
        if (buffers[i]->kind != p->kinds[i]) give_up("buffer", "of another kind than the shader's");
        infos[i].buffer = buffers[i]->buffer;
        infos[i].offset = 0;
        infos[i].range = VK_WHOLE_SIZE;
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = p->set;
        writes[i].dstBinding = (uint32_t)i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = type_of(p->kinds[i]);
        writes[i].pBufferInfo = &infos[i];
    }
    vkUpdateDescriptorSets(g->device, (uint32_t)p->count, writes, 0, NULL);
    vkCmdBindPipeline(g->commands, point, p->pipeline);
    vkCmdBindDescriptorSets(g->commands, point, p->layout, 0, 1, &p->set, 0, NULL);
}

double gpu_run(gpu_program *p, gpu_buffer *const *buffers, int groups_x, int groups_y, int groups_z) {
    gpu *g = p->device;
    commands_begin(g);
    program_bind(p, buffers, VK_PIPELINE_BIND_POINT_COMPUTE);
    time_begin(g);
    vkCmdDispatch(g->commands, (uint32_t)groups_x, (uint32_t)groups_y, (uint32_t)groups_z);
    return time_finish(g);
}

static void change_layout(gpu *g, VkImage image, VkImageLayout from, VkImageLayout to) {
    VkImageMemoryBarrier barrier = {0};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.image = image;
    barrier.subresourceRange.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT;
    barrier.subresourceRange.levelCount = 1;
    barrier.subresourceRange.layerCount = 1;
    vkCmdPipelineBarrier(g->commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0,
                         NULL, 0, NULL, 1, &barrier);
}

typedef struct {
    VkImage image;
    VkDeviceMemory memory;
    VkImageView view;
} target;

static target target_of(gpu *g, int width, int height) {
    target t;
    VkImageCreateInfo image = {0};
    VkImageViewCreateInfo view = {0};
    VkMemoryRequirements needs;
    image.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    image.imageType = VK_IMAGE_TYPE_2D;
    image.format = picture_format;
    image.extent.width = (uint32_t)width;
    image.extent.height = (uint32_t)height;
    image.extent.depth = 1;
    image.mipLevels = 1;
    image.arrayLayers = 1;
    image.samples = VK_SAMPLE_COUNT_1_BIT;
    image.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    must(vkCreateImage(g->device, &image, NULL, &t.image), "picture on the GPU");
    vkGetImageMemoryRequirements(g->device, t.image, &needs);
    t.memory = memory_create(g, &needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    must(vkBindImageMemory(g->device, t.image, t.memory, 0), "picture on the GPU");
    view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view.image = t.image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = picture_format;
    view.subresourceRange.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT;
    view.subresourceRange.levelCount = 1;
    view.subresourceRange.layerCount = 1;
    must(vkCreateImageView(g->device, &view, NULL, &t.view), "picture on the GPU");
    return t;
}

double gpu_draw(gpu_program *p, gpu_buffer *const *buffers, int width, int height, float *pixels) {
    gpu *g = p->device;
    target t = target_of(g, width, height);
    gpu_buffer staging = staging_of(g, (size_t)width * (size_t)height * 4 * sizeof *pixels);
    VkRenderingAttachmentInfo attachment = {0};
    VkRenderingInfo rendering = {0};
    VkViewport viewport = {0};
    VkBufferImageCopy region = {0};
    double ms;
    attachment.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    attachment.imageView = t.view;
    attachment.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    rendering.renderArea.extent.width = (uint32_t)width;
    rendering.renderArea.extent.height = (uint32_t)height;
    rendering.layerCount = 1;
    rendering.colorAttachmentCount = 1;
    rendering.pColorAttachments = &attachment;
    viewport.width = (float)width;
    viewport.height = (float)height;
    viewport.maxDepth = 1;
    commands_begin(g);
    change_layout(g, t.image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    program_bind(p, buffers, VK_PIPELINE_BIND_POINT_GRAPHICS);
    time_begin(g);
    vkCmdBeginRendering(g->commands, &rendering);
    vkCmdSetViewport(g->commands, 0, 1, &viewport);
    vkCmdSetScissor(g->commands, 0, 1, &rendering.renderArea);
    vkCmdDraw(g->commands, 3, 1, 0, 0);
    vkCmdEndRendering(g->commands);
    ms = time_finish(g);
    region.imageSubresource.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT;
    region.imageSubresource.layerCount = 1;
    region.imageExtent.width = (uint32_t)width;
    region.imageExtent.height = (uint32_t)height;
    region.imageExtent.depth = 1;
    commands_begin(g);
    change_layout(g, t.image, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    vkCmdCopyImageToBuffer(g->commands, t.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, staging.buffer, 1, &region);
    commands_finish(g);
    memcpy(pixels, staging_map(&staging), staging.size);
    buffer_release(&staging);
    vkDestroyImageView(g->device, t.view, NULL);
    vkDestroyImage(g->device, t.image, NULL);
    vkFreeMemory(g->device, t.memory, NULL);
    return ms;
}
