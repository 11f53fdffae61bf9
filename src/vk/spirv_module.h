// SPDX-License-Identifier: MIT
#pragma once

#include <spirv/unified1/spirv.hpp11>

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace zvo::vk
{

/// Throws Error{Other} that tells why a module is not a kernel.
[[noreturn]] void failModule(const std::string& what);

/// The declarations of a SPIR-V module that its interface depends on, by result id (Khronos SPIR-V specification 1.6,
/// section 2.3). The functions throw as failModule().
class SpirvModule
{
public:
    /// A type or constant.
    struct Declaration
    {
        spv::Op op{};
        std::span<const std::uint32_t> operands; // without the result id; constants: the type, then the values
    };

    /// A member of a struct.
    struct Member
    {
        std::uint32_t offset = 0;
        std::uint32_t matrix_stride = 0;
        bool is_row_major = false;
    };

    /// A variable that stands for a buffer or an image outside of the kernel.
    struct Variable
    {
        std::uint32_t id = 0;
        spv::StorageClass storage{};
    };

    /// words must outlive the object.
    explicit SpirvModule(std::span<const std::uint32_t> words);

    [[nodiscard]] const Declaration& declaration(std::uint32_t id) const;

    /// The type that id's declaration names at index, or its number there.
    [[nodiscard]] std::uint32_t operand(std::uint32_t id, std::size_t index) const;

    /// The value of a constant, or its first word.
    [[nodiscard]] std::uint32_t constant(std::uint32_t id) const;

    /// The name of an id, or of a member of a struct; empty if it has none.
    [[nodiscard]] std::string name(std::uint32_t id) const;
    [[nodiscard]] std::string memberName(std::uint32_t id, std::uint32_t member) const;

    std::uint32_t entry_point_count = 0; // of kernels
    std::span<const std::uint32_t> local_size;
    bool is_local_size_by_id = false;
    std::uint32_t workgroup_size = 0;            // id of the constant that is the built-in, 0: none
    std::optional<std::uint32_t> push_constants; // type of the pointer to the block
    std::map<std::uint32_t, std::span<const std::uint32_t>> constants;
    std::map<std::uint32_t, std::uint32_t> spec_ids; // constant -> SpecId
    std::map<std::uint32_t, std::uint32_t> array_strides;
    std::map<std::uint32_t, std::uint32_t> bindings;                  // variable -> Binding
    std::map<std::uint32_t, std::uint32_t> descriptor_sets;           // variable -> DescriptorSet
    std::vector<Variable> resources;                                  // what descriptors stand for
    std::map<std::uint32_t, std::map<std::uint32_t, Member>> members; // struct -> member index -> layout

private:
    void visit(spv::Op op, std::span<const std::uint32_t> operands);
    void visitVariable(std::uint32_t id, std::uint32_t type, spv::StorageClass storage);
    void visitExecutionMode(spv::ExecutionMode mode, std::span<const std::uint32_t> operands);
    void visitDecoration(std::uint32_t target, spv::Decoration decoration, std::span<const std::uint32_t> operands);
    static void visitMemberDecoration(Member& member, spv::Decoration decoration,
                                      std::span<const std::uint32_t> operands);

    static std::string text(std::span<const std::uint32_t> words);

    std::map<std::uint32_t, std::span<const std::uint32_t>> m_names;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::span<const std::uint32_t>> m_member_names;
    std::map<std::uint32_t, Declaration> m_declarations;
};

} // namespace zvo::vk
