// SPDX-License-Identifier: MIT
#pragma once

#include "common/signals.h"
#include "demo/app/editor.h"
#include "demo/app/options.h"
#include "demo/app/scene_memory.h"
#include "demo/app/screenshot.h"
#include "demo/app/settings.h"
#include "demo/app/shader_sources.h"
#include "demo/app/ui.h"
#include "demo/app/view_settings.h"
#include "demo/app/window.h"
#include "demo/input/camera_control.h"
#include "demo/input/camera_flight.h"
#include "demo/input/input_script.h"
#include "demo/input/keys.h"
#include "demo/input/sun_control.h"
#include "demo/input/timeline.h"
#include "demo/panels/file_dialog.h"
#include "demo/panels/frame_stats.h"
#include "demo/panels/notices.h"
#include "demo/panels/panel_files.h"
#include "demo/panels/panels.h"
#include "demo/world/compose.h"
#include "demo/world/loading.h"
#include "demo/world/refinement.h"
#include "demo/world/renderer.h"
#include "demo/world/resolution_ladder.h"
#include "demo/world/view_state.h"
#include "demo/world/world.h"
#include "vk/headless.h"
#include "vk/swapchain.h"

#include <chrono>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace zvo::demo
{

/// The program: a window, the world that it shows, and the work of a frame.
class App
{
public:
    /// start: when the program began. Throws Error if there is no display or no device, or if the scene that options
    /// name cannot be shown.
    App(const DemoOptions& options, std::chrono::steady_clock::time_point start);

    /// Waits until the device is done with all frames.
    ~App();
    App(const App&) = delete;
    App& operator=(const App&) = delete;

    /// Runs frame by frame until the user quits. Throws Error if a frame cannot be made, if results cannot be written,
    /// or if the validation layers have reported anything.
    void run();

private:
    using Clock = std::chrono::steady_clock;

    // What a frame is asked about single pixels.
    struct FrameLooks
    {
        std::unique_ptr<PixelProbe> probe; // null: nothing is asked
        // Places in the probe's reports:
        std::optional<std::size_t> inspected; // the pixel under the pointer
        glm::uvec2 inspected_pixel{0U};
        std::optional<std::size_t> picked;              // for a key of tools
        Action pick = Action::None;                     // of that key
        std::optional<std::size_t> focus;               // of the lens
        std::vector<std::optional<std::size_t>> stroke; // nothing: outside of the window
    };

    // A frame that is under way on the device.
    struct FrameInFlight
    {
        std::uint64_t number = 0;                 // this program's number
        std::optional<std::uint64_t> world_frame; // the world's number; nothing: the frame shows an earlier picture
        double internal_scale = 1;
        std::uint64_t primary_ray_count = 0;
        Integrator integrator = Integrator::Primary;
        std::unique_ptr<vk::BufferOf<gpu::DispatchArgs>> ray_lists; // of path tracing
        std::unique_ptr<Screenshot> screenshot;
        bool is_last_picture = false; // the screenshot is the one that the command line asks for
        FrameLooks looks;

        /// Once the device is done.
        [[nodiscard]] RaysOfFrame rays() const
        {
            return ray_lists == nullptr
                       ? RaysOfFrame{primary_ray_count, integrator}
                       : RaysOfFrame{rayCountOf({ray_lists->mappedData(), ray_lists->count()}), Integrator::Path};
        }

        /// Destroyed first: its destructor waits for the device, which writes to the other members.
        vk::Submission submission;
    };

    void tick();
    void frame();
    void beginFrame(double rest_seconds);
    void countFrame();
    void takeInput(double rest_seconds);
    void apply(const InputEvent& event);
    void onKey(const KeyEvent& event);
    void perform(const KeyBinding& binding, Key key);
    void advanceTime();
    void buildPanels();
    bool drawOverlay();
    bool drawBrushCursor();
    void buildPanel();
    void toolsPanel();
    void draw();
    void drawLive();
    void drawKept();
    bool prepare(const Picture& picture);
    void present(FrameInFlight frame, const std::function<void(vk::FrameGraph&)>& trace);
    Picture pictureIn(PictureSize traced);
    Composition composition();
    void measure(bool still);

    void drawStill();
    bool beginStill();
    void refuseStill(const Error& error);
    void takeDevelopment();
    FrameInFlight tracingFrame();
    void addSample();
    void develop();
    void inspectStill();
    void frameWithin();
    void abandonIfChanged();
    void whenFree(std::function<void()> action);
    void noteRedraw();
    [[nodiscard]] PictureSize fullSize() const;
    [[nodiscard]] PictureState pictureState() const;
    [[nodiscard]] bool moves() const;
    [[nodiscard]] bool hasSun() const;
    [[nodiscard]] bool isRefinedEnough() const;
    [[nodiscard]] double restSeconds() const;
    [[nodiscard]] std::size_t framesInFlight() const;

    void finishOldest();
    FrameLooks takeLooks();
    void answer(const FrameLooks& looks);
    void noteIdleStrokes();
    void keep(const FrameInFlight& frame);
    void finishAll();
    std::unique_ptr<Screenshot> takeScreenshot(PictureSize size);
    [[nodiscard]] bool isLastPicture() const;
    [[nodiscard]] bool wantsScreenshot() const;

    void loadFiles(const std::vector<std::filesystem::path>& files);
    void beginFirstWorld();
    void beginLoading(WorldOptions options);
    void continueLoading();
    void loadAtOnce(const WorldOptions& options);
    void showFirst(std::unique_ptr<World> world);
    void show(std::unique_ptr<World> world, const WorldOptions& options);
    void request(const EditRequest& request);
    void carryOutOrders();
    void carryOut(const FloodOrder& order);
    void carryOut(const CopyOrder& order);
    void carryOut(const PasteOrder& order);
    void carryOut(const MoveOrder& order);
    void carryOut(const DeleteOrder& order);
    void editSelection(Action action);
    bool isMakingAWorld();
    void applyViewOptions();
    void setEnvironment(const cli::EnvironmentOptions& options);
    void focusOn(const gpu::PixelReport& report);
    void loadEnvironment(const std::filesystem::path& file);
    bool save();
    bool write(const std::filesystem::path& file, bool overwrites);
    void saveAs(const std::filesystem::path& file);
    void savePicture(const std::filesystem::path& file);
    void openDialog();
    void saveDialog();
    bool drawDialogs();
    void drawLossQuestion();
    [[nodiscard]] bool hasDialog() const;
    void loseStrokes(std::function<void()> action);
    void quit();
    void filesPanel();
    void rememberScene();
    bool recallScene();
    [[nodiscard]] std::string editedName() const;
    [[nodiscard]] bool hasUnsaved() const;
    void showTitle();
    void storeBookmark(std::size_t number);
    void recallBookmark(std::size_t number);
    void frameScene();
    void copyCamera();
    void pasteCamera();
    void changeView(int by);
    void toggleRecording();
    void togglePath();
    void reloadChangedShaders();
    void keepSettings();

    [[nodiscard]] std::optional<glm::uvec2> pixelAt(const glm::dvec2& point) const;
    [[nodiscard]] double aspect() const;
    [[nodiscard]] double internalScale() const;
    [[nodiscard]] std::optional<std::uint32_t> shownSamples() const;
    [[nodiscard]] double worldSeconds() const;
    MemoryUse memoryUse();
    void note(const std::string& text);
    void takeTold();
    void writeStats();

    const DemoOptions m_options;
    Settings m_settings; // at the beginning; the scenes are those of now
    ViewState m_view;
    Clock::time_point m_start;
    std::unique_ptr<cli::Output> m_screenshot_output; // of the last frame
    std::unique_ptr<cli::Output> m_stats_output;
    std::unique_ptr<cli::Output> m_record_output;
    std::optional<InputReplay> m_replay;

    WorldOptions m_world_options; // of m_world
    std::unique_ptr<Loading>
        m_loading; // null: nothing is being loaded. The first files are read while the window opens
    Window m_window;
    vk::HeadlessDevice m_device;
    vk::Swapchain m_swapchain;
    ComposePass m_compose_pass;
    Ui m_ui;
    std::unique_ptr<World> m_world;
    std::optional<WorldOptions> m_loads_next; // when what is being loaded has been cancelled
    Renderer m_renderer;
    std::deque<FrameInFlight> m_frames_in_flight;

    Editor m_editor;
    VoxelClip m_clip;                   // what was copied, of this world
    EditPoint m_saved_point;            // what is in a file
    std::filesystem::path m_saved_file; // for Ctrl+S; empty: a new one
    FileDialog m_file_dialog;
    std::function<void()> m_after_loss; // what the user is asked about, as strokes are lost by it; null: nothing
    std::string m_title;
    PanelState m_panels;
    Notices m_notices;
    std::mutex m_told_mutex;
    std::vector<std::string> m_told; // by any thread, to be noticed
    Timeline m_timeline;
    CameraControl m_camera;
    Bookmarks m_bookmarks;
    SunControl m_sun;
    CameraFlight m_flight;
    ShaderSources m_shaders;
    std::string m_shader_message; // of the compiler
    std::optional<MouseMoveEvent> m_mouse;
    std::optional<InspectedPixel> m_inspected;
    bool m_wants_focus = false; // at the pointer
    std::vector<ScriptedEvent> m_recorded;
    std::optional<bool> m_wanted_screenshot; // with panels, or without
    std::optional<ResolutionLadder> m_ladder;
    FrameStats m_stats;
    std::uint64_t m_frame = 0;       // of the loop
    std::uint64_t m_drawn_count = 0; // frames that were drawn
    Clock::time_point m_frame_start;
    std::chrono::duration<double> m_passed{0}; // since the frame before
    double m_frame_seconds = 0;                // that this frame takes
    std::optional<double> m_first_frame_ms;
    bool m_has_map = false;      // an environment map lights the picture
    bool m_has_overlay = false;  // over the picture, whether or not panels are shown
    bool m_lacks_memory = false; // for a picture of the window's size

    Refinement m_refinement;
    Picture m_refined;              // the still picture
    FrameOptions m_developed;       // of the samples that are shown
    std::uint32_t m_shown_from = 1; // samples of the still picture with which it is shown
    bool m_is_refined = false;      // m_refined is being made, and the last kept picture is shown
    bool m_has_samples = false;     // m_refined has a sample in its own size
    bool m_is_within = false;       // input is taken in the middle of a sample
    bool m_makes_world = false;     // the device is making a world
    bool m_is_first_world = false;  // the first files are being loaded, and nothing else is shown
    std::optional<cli::InterruptWatch> m_watch;
    bool m_has_traced = false;                          // a picture
    int m_redraws = 0;                                  // frames in which panels are drawn anew
    double m_since_redraw = 0;                          // seconds
    std::vector<std::function<void()>> m_when_free;     // what waits for the end of a sample
    std::tuple<Integrator, View, bool> m_measured = {}; // what m_stats are about
    bool m_quits = false;
};

} // namespace zvo::demo
