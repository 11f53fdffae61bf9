// SPDX-License-Identifier: MIT
// The table of keys and their actions, which is also shown by F1 and in docs/window.md.
#pragma once

#include "demo/input/input_event.h"

#include <array>
#include <optional>
#include <string_view>

namespace zvo::demo
{

/// The action of a key.
enum class Action
{
    None, // handled by the camera or the mouse
    ShowKeys,
    ShowPanels,
    NextView,
    PreviousView,
    FrameScene,
    Copy,
    Paste,
    Cut,
    Delete,
    StoreBookmark,
    RecallBookmark,
    RecordPath,
    PlayPath,
    PlayScene,
    NextFrame,
    UseBrush,
    UseHand,
    UseCamera,
    NextBrush,
    SmallerBrush,
    LargerBrush,
    TakeColor,
    UseSelection,
    NextForm,
    NextMirror,
    PlaceMirror,
    Undo,
    Redo,
    Save,
    SaveAs,
    Open,
    Focus,
    ReloadShaders,
    Screenshot,
    ScreenshotOfPicture,
    Quit,
};

/// A row of the table.
struct KeyBinding
{
    std::string_view keys; // text for people
    std::string_view what;
    Action action = Action::None;
    Key key = Key::Escape;      // if it has an action
    Key last_key = Key::Escape; // of a range that begins with key
    bool shift = false;
    bool control = false;
};

constexpr KeyBinding boundTo(std::string_view keys, Action action, Key key, std::string_view what, bool shift = false,
                             bool control = false)
{
    return {keys, what, action, key, key, shift, control};
}

inline constexpr std::array kKeyBindings = {
    KeyBinding{"W A S D, E Q", "fly forward, left, back, right, up and down; Shift: four times as fast"},
    KeyBinding{"right mouse button", "look around; with the wheel: change the speed"},
    KeyBinding{"left mouse button", "orbit around what is in front of the camera, or use the tool; Alt: orbit always"},
    KeyBinding{"middle mouse button", "move sideways"},
    KeyBinding{"wheel", "go nearer or farther"},
    boundTo("F", Action::FrameScene, Key::F, "show the whole scene"),
    KeyBinding{"Ctrl+1 to Ctrl+9", "keep the camera as a bookmark", Action::StoreBookmark, Key::Digit1, Key::Digit9,
               false, true},
    KeyBinding{"1 to 9", "go to a bookmark", Action::RecallBookmark, Key::Digit1, Key::Digit9},
    boundTo("Ctrl+C", Action::Copy, Key::C,
            "copy the camera, as zvo render --camera takes it, or the voxels that are selected", false, true),
    boundTo("Ctrl+V", Action::Paste, Key::V,
            "take the camera that was copied; of the tool that selects, paste voxels at the pointer", false, true),
    boundTo("Ctrl+X", Action::Cut, Key::X, "cut the voxels that are selected", false, true),
    boundTo("Delete", Action::Delete, Key::Delete, "delete the voxels that are selected"),
    boundTo("R", Action::RecordPath, Key::R, "begin or end recording a camera path"),
    boundTo("P", Action::PlayPath, Key::P, "fly along the camera path, or stop"),
    boundTo("Space", Action::PlayScene, Key::Space, "let the scene move, or stop it"),
    boundTo("Period", Action::NextFrame, Key::Period, "let the scene move by one frame"),
    boundTo("B", Action::UseBrush, Key::B, "edit voxels with a brush"),
    boundTo("M", Action::UseHand, Key::M, "drag what moves"),
    boundTo("T", Action::UseSelection, Key::T, "select a box; Shift and drag moves it with its voxels"),
    boundTo("Escape", Action::UseCamera, Key::Escape, "put the tool away"),
    boundTo("N", Action::NextBrush, Key::N, "carve, fill or paint"),
    boundTo("O", Action::NextForm, Key::O, "draw strokes, boxes or floods of a colour; Shift and click draws a line"),
    boundTo("X", Action::NextMirror, Key::X, "mirror across the next axis, or none"),
    boundTo("Shift+X", Action::PlaceMirror, Key::X, "mirror at the voxel under the pointer", true),
    boundTo("[", Action::SmallerBrush, Key::LeftBracket, "a smaller brush"),
    boundTo("]", Action::LargerBrush, Key::RightBracket, "a larger brush"),
    boundTo("K", Action::TakeColor, Key::K, "take the colour under the pointer for the brush"),
    boundTo("Ctrl+Z", Action::Undo, Key::Z, "undo the last stroke or move", false, true),
    boundTo("Ctrl+Shift+Z", Action::Redo, Key::Z, "do it again", true, true),
    boundTo("Ctrl+S", Action::Save, Key::S,
            "save what is shown: a new .zvo file in the working folder, or the last one saved as", false, true),
    boundTo("Ctrl+Shift+S", Action::SaveAs, Key::S, "save as .zvo, .vox, .ply, .glb or .nvdb, or the picture", true,
            true),
    boundTo("Ctrl+O", Action::Open, Key::O, "open a file", false, true),
    KeyBinding{"L and the mouse", "move the sun"},
    boundTo("G", Action::Focus, Key::G, "focus the lens on what is under the pointer"),
    boundTo("V", Action::NextView, Key::V, "the next view"),
    boundTo("Shift+V", Action::PreviousView, Key::V, "the view before", true),
    boundTo("H", Action::ShowPanels, Key::H, "show or hide the panels"),
    boundTo("F1", Action::ShowKeys, Key::F1, "show or hide this table"),
    boundTo("F5", Action::ReloadShaders, Key::F5, "compile the shaders that have changed"),
    boundTo("F12", Action::Screenshot, Key::F12, "write a screenshot to the working folder"),
    boundTo("Shift+F12", Action::ScreenshotOfPicture, Key::F12, "the same without the panels", true),
    boundTo("Ctrl+Q", Action::Quit, Key::Q, "quit", false, true),
};

/// The row for a key that is pressed; null if there is none.
const KeyBinding* bindingOf(const KeyEvent& event);

} // namespace zvo::demo
