// SPDX-License-Identifier: MIT
#include "demo/app/ui.h"

#include "demo/app/window.h"
#include "vk/check.h"
#include "zvo/error.h"

#include <imgui.h>
// Debian's backend calls Vulkan through the loader's own functions; nothing else does.
#include <backends/imgui_impl_vulkan.h>

#include <algorithm>
#include <span>
#include <variant>

namespace zvo::demo
{

namespace
{

constexpr float kFontPixels = 14;

void onResult(VkResult result)
{
    if (result < 0)
    {
        vk::throwFailedCall(result, "vk call of Dear ImGui", __FILE_NAME__, __LINE__);
    }
}

int indexOf(Key key)
{
    return static_cast<int>(key);
}

// Passes an event to Dear ImGui. Returns whether it was for the panels.
struct Feed
{
    ImGuiIO& io;
    std::span<Ui::Button> buttons;
    std::span<Ui::Button> keys;

    bool operator()(const KeyEvent& event) const
    {
        keys[static_cast<std::size_t>(event.key)].take(event.pressed);
        return event.pressed && io.WantTextInput; // everybody sees a key's release
    }
    bool operator()(const TextEvent& event) const
    {
        io.AddInputCharactersUTF8(event.text.c_str());
        return io.WantTextInput;
    }
    bool operator()(const MouseMoveEvent& event) const
    {
        io.MousePos = {static_cast<float>(event.x), static_cast<float>(event.y)};
        return false;
    }
    bool operator()(const MouseButtonEvent& event) const
    {
        buttons[static_cast<std::size_t>(event.button)].take(event.pressed);
        return event.pressed && io.WantCaptureMouse;
    }
    bool operator()(const WheelEvent& event) const
    {
        io.MouseWheel += static_cast<float>(event.y);
        io.MouseWheelH += static_cast<float>(event.x);
        return io.WantCaptureMouse;
    }
    template <typename Other> bool operator()(const Other&) const { return false; }
};

} // namespace

Ui::Ui(vk::HeadlessDevice& device, const ComposePass& pass, Window& window, std::uint32_t frames_in_flight)
    : m_device(device), m_window(window), m_scale(window.uiScale())
{
    makeDescriptorPool();
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr; // settings.h stores what is kept
    io.LogFilename = nullptr;
    ImFontConfig font;
    font.SizePixels = kFontPixels * m_scale;
    io.Fonts->AddFontDefault(&font);
    setUpKeys();
    ImGui::StyleColorsDark();
    ImGui::GetStyle().WindowRounding = 4;
    ImGui::GetStyle().ScaleAllSizes(m_scale);

    const vk::DeviceHandles& handles = device.device().handles();
    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = handles.instance;
    info.PhysicalDevice = handles.physical_device;
    info.Device = handles.device;
    info.QueueFamily = handles.queue_family;
    info.Queue = device.queue();
    info.PipelineCache = handles.pipeline_cache;
    info.DescriptorPool = m_descriptors;
    info.MinImageCount = std::max(frames_in_flight, 2U);
    info.ImageCount = info.MinImageCount; // sets of vertices, used in turns
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    info.CheckVkResultFn = onResult;
    ImGui_ImplVulkan_Init(&info, pass.handle());
    device.run(
        [](vk::FrameGraph& graph) {
            graph.record("panels/font", {},
                         [](VkCommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(commands); });
        });
    ImGui_ImplVulkan_DestroyFontUploadObjects();
}

Ui::~Ui()
{
    const vk::Device& device = m_device.device();
    device.fn().vkDeviceWaitIdle(device.handle());
    ImGui_ImplVulkan_Shutdown();
    ImGui::DestroyContext();
    device.fn().vkDestroyDescriptorPool(device.handle(), m_descriptors, nullptr);
}

void Ui::makeDescriptorPool()
{
    const VkDescriptorPoolSize font = {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};
    VkDescriptorPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
    info.maxSets = 1;
    info.poolSizeCount = 1;
    info.pPoolSizes = &font;
    const vk::Device& device = m_device.device();
    VK_CHECK(device.fn().vkCreateDescriptorPool(device.handle(), &info, nullptr, &m_descriptors));
    device.setName(VK_OBJECT_TYPE_DESCRIPTOR_POOL, reinterpret_cast<std::uint64_t>(m_descriptors), "panels");
}

void Ui::setUpKeys()
{
    ImGuiIO& io = ImGui::GetIO();
    static_assert(kKeyCount <= IM_ARRAYSIZE(ImGuiIO::KeysDown));
    constexpr std::pair<ImGuiKey, Key> kKeys[] = {{ImGuiKey_Tab, Key::Tab},
                                                  {ImGuiKey_LeftArrow, Key::Left},
                                                  {ImGuiKey_RightArrow, Key::Right},
                                                  {ImGuiKey_UpArrow, Key::Up},
                                                  {ImGuiKey_DownArrow, Key::Down},
                                                  {ImGuiKey_PageUp, Key::PageUp},
                                                  {ImGuiKey_PageDown, Key::PageDown},
                                                  {ImGuiKey_Home, Key::Home},
                                                  {ImGuiKey_End, Key::End},
                                                  {ImGuiKey_Insert, Key::Insert},
                                                  {ImGuiKey_Delete, Key::Delete},
                                                  {ImGuiKey_Backspace, Key::Backspace},
                                                  {ImGuiKey_Space, Key::Space},
                                                  {ImGuiKey_Enter, Key::Enter},
                                                  {ImGuiKey_Escape, Key::Escape},
                                                  {ImGuiKey_A, Key::A},
                                                  {ImGuiKey_C, Key::C},
                                                  {ImGuiKey_V, Key::V},
                                                  {ImGuiKey_X, Key::X},
                                                  {ImGuiKey_Y, Key::Y},
                                                  {ImGuiKey_Z, Key::Z}};
    for (const auto& [theirs, ours] : kKeys)
    {
        io.KeyMap[theirs] = indexOf(ours);
    }
    io.ClipboardUserData = this;
    io.SetClipboardTextFn = [](void* ui, const char* text) { static_cast<Ui*>(ui)->m_window.setClipboard(text); };
    io.GetClipboardTextFn = [](void* ui) -> const char*
    {
        Ui& self = *static_cast<Ui*>(ui);
        self.m_clipboard = self.m_window.clipboard();
        return self.m_clipboard.c_str();
    };
}

bool Ui::handle(const InputEvent& event)
{
    return std::visit(Feed{ImGui::GetIO(), m_buttons, m_keys}, event);
}

void Ui::build(PictureSize window, PictureSize framebuffer, double seconds, const std::function<void()>& panels)
{
    constexpr double kShortest = 1e-4; // Dear ImGui requires that time passes
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(window.width), static_cast<float>(window.height)};
    if (window.width != 0 && window.height != 0)
    {
        io.DisplayFramebufferScale = {static_cast<float>(framebuffer.width) / static_cast<float>(window.width),
                                      static_cast<float>(framebuffer.height) / static_cast<float>(window.height)};
    }
    for (std::size_t i = 0; i < m_buttons.size(); ++i)
    {
        io.MouseDown[i] = m_buttons[i].forFrame();
    }
    for (std::size_t i = 0; i < m_keys.size(); ++i)
    {
        io.KeysDown[i] = m_keys[i].forFrame();
    }
    io.KeyShift = io.KeysDown[indexOf(Key::LeftShift)] || io.KeysDown[indexOf(Key::RightShift)];
    io.KeyCtrl = io.KeysDown[indexOf(Key::LeftControl)] || io.KeysDown[indexOf(Key::RightControl)];
    io.KeyAlt = io.KeysDown[indexOf(Key::LeftAlt)] || io.KeysDown[indexOf(Key::RightAlt)];
    io.DeltaTime = static_cast<float>(std::max(seconds, kShortest));
    ImGui_ImplVulkan_NewFrame();
    ImGui::NewFrame();
    panels();
    ImGui::Render();
}

void Ui::draw(VkCommandBuffer commands)
{
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands);
}

} // namespace zvo::demo
