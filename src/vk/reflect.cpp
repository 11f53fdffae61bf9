// SPDX-License-Identifier: MIT
// Reads what the host must know of a kernel from its SPIR-V.
#include "vk/kernel.h"
#include "vk/spirv_module.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>

namespace zvo::vk
{

namespace
{

constexpr std::uint32_t kPointerBytes = 8;
constexpr std::uint32_t kMaxBytes = 1 << 20; // far above any push constant block; keeps broken modules from overflowing
constexpr int kMaxNesting = 32;

// Names of the variables of lib/bound.glsl begin so.
constexpr std::string_view kTexelNames[] = {"texels1_", "texels2_", "texels3_", "texels4_"};
constexpr std::string_view kStorageName = "storage_";

struct Layout
{
    std::uint32_t bytes = 0;
    std::uint32_t alignment = 1;
};

// The interface of a module.
class Reflection
{
public:
    explicit Reflection(std::span<const std::uint32_t> words) : m_module(words) {}

    [[nodiscard]] KernelInterface interface() const
    {
        if (m_module.entry_point_count != 1)
        {
            failModule(fmt::format("it has {} compute entry points instead of one", m_module.entry_point_count));
        }
        KernelInterface result;
        readLocalSize(result);
        if (m_module.push_constants)
        {
            const Layout block = layout(m_module.operand(*m_module.push_constants, 1), nullptr, 0);
            result.push_constant_bytes = block.bytes;
        }
        result.bindings = bindings();
        for (const auto& [id, spec_id] : m_module.spec_ids)
        {
            result.constants.push_back(specializationConstant(id, spec_id));
        }
        // A specialized local size appears twice in the module; if it has a name, one of them lacks it.
        std::vector<ModuleConstant>& constants = result.constants;
        std::ranges::sort(constants, [](const ModuleConstant& a, const ModuleConstant& b)
                          { return a.id != b.id ? a.id < b.id : a.name > b.name; });
        const auto last = std::unique(constants.begin(), constants.end(),
                                      [](const ModuleConstant& a, const ModuleConstant& b) { return a.id == b.id; });
        constants.erase(last, constants.end());
        for (ModuleConstant& constant : constants)
        {
            const auto size = std::ranges::find(result.local_size_ids, constant.id);
            if (constant.name.empty() && size != result.local_size_ids.end())
            {
                constant.name = std::string("kLocalSize") + "XYZ"[size - result.local_size_ids.begin()];
            }
        }
        return result;
    }

private:
    void readLocalSize(KernelInterface& result) const
    {
        // The WorkgroupSize built-in overrules the execution mode where a module has both.
        std::span<const std::uint32_t> sizes = m_module.local_size;
        bool by_id = m_module.is_local_size_by_id;
        const auto built_in = m_module.constants.find(m_module.workgroup_size);
        if (built_in != m_module.constants.end())
        {
            sizes = built_in->second;
            by_id = true;
        }
        if (sizes.size() < result.local_size.size())
        {
            failModule("it has no local size");
        }
        for (std::size_t i = 0; i < result.local_size.size(); ++i)
        {
            result.local_size[i] = by_id ? m_module.constant(sizes[i]) : sizes[i];
            const auto spec_id = m_module.spec_ids.find(sizes[i]);
            if (by_id && spec_id != m_module.spec_ids.end())
            {
                result.local_size_ids[i] = spec_id->second;
            }
        }
    }

    // Buffers that the module reaches through descriptors, as lib/bound.glsl names and numbers them.
    [[nodiscard]] std::vector<ModuleBinding> bindings() const
    {
        std::vector<ModuleBinding> result;
        for (const SpirvModule::Variable& resource : m_module.resources)
        {
            const std::string name = m_module.name(resource.id);
            const auto set = m_module.descriptor_sets.find(resource.id);
            const auto binding = m_module.bindings.find(resource.id);
            const auto texels = std::ranges::find_if(kTexelNames, [&](auto begin) { return name.starts_with(begin); });
            const bool is_texels = texels != std::end(kTexelNames);
            const spv::StorageClass storage =
                is_texels ? spv::StorageClass::UniformConstant : spv::StorageClass::StorageBuffer;
            if (resource.storage != storage || !(is_texels || name.starts_with(kStorageName)) ||
                set == m_module.descriptor_sets.end() || set->second != 0 || binding == m_module.bindings.end())
            {
                failModule(fmt::format("{} is not a buffer of lib/bound.glsl", name));
            }
            ModuleBinding& bound = result.emplace_back();
            bound.binding = binding->second;
            bound.texel_words = is_texels ? static_cast<std::uint32_t>(texels - std::begin(kTexelNames)) + 1 : 0;
            bound.name = name.substr(is_texels ? texels->size() : kStorageName.size());
            bound.address_offset = addressOffset(bound.name);
        }
        std::ranges::sort(result, {}, &ModuleBinding::binding);
        if (std::ranges::adjacent_find(result, {}, &ModuleBinding::binding) != result.end())
        {
            failModule("two of its buffers have the same binding");
        }
        return result;
    }

    // Where the parameters' member of that name, an address, stands in the push constants; ModuleBinding::kNoAddress if
    // there is none.
    [[nodiscard]] std::uint32_t addressOffset(std::string_view name) const
    {
        if (m_module.push_constants)
        {
            const std::uint32_t block = m_module.operand(*m_module.push_constants, 1);
            const std::uint32_t params = m_module.operand(block, 0);
            const SpirvModule::Declaration& found = m_module.declaration(params);
            const auto layouts = m_module.members.find(params);
            for (std::uint32_t i = 0; found.op == spv::Op::OpTypeStruct && i < found.operands.size(); ++i)
            {
                if (m_module.memberName(params, i) == name && layouts != m_module.members.end() &&
                    layouts->second.count(i) != 0 &&
                    m_module.declaration(found.operands[i]).op == spv::Op::OpTypePointer)
                {
                    return layouts->second.at(i).offset;
                }
            }
        }
        return ModuleBinding::kNoAddress;
    }

    [[nodiscard]] ModuleConstant specializationConstant(std::uint32_t id, std::uint32_t spec_id) const
    {
        ModuleConstant result{spec_id, m_module.name(id), ConstantType::Other, 0};
        const auto constant = m_module.constants.find(id);
        if (constant == m_module.constants.end())
        {
            return result;
        }
        const std::uint32_t type = m_module.operand(id, 0);
        const spv::Op type_op = m_module.declaration(type).op;
        if (type_op == spv::Op::OpTypeBool)
        {
            result.type = ConstantType::Bool;
            result.value = m_module.declaration(id).op == spv::Op::OpSpecConstantTrue ? 1 : 0;
            return result;
        }
        if (m_module.operand(type, 0) != 32)
        {
            failModule(fmt::format("specialization constant {} is not 32 bits wide", spec_id));
        }
        if (type_op == spv::Op::OpTypeInt)
        {
            result.type = m_module.operand(type, 1) == 0 ? ConstantType::Uint : ConstantType::Int;
        }
        result.value = m_module.constant(id);
        return result;
    }

    // Size with tail padding and alignment, by the rules of the scalar layout, which are those of C++.
    [[nodiscard]] Layout layout(std::uint32_t type, const SpirvModule::Member* member, int nesting) const
    {
        if (nesting > kMaxNesting)
        {
            failModule("its push constants nest too deep");
        }
        const SpirvModule::Declaration& found = m_module.declaration(type);
        switch (found.op)
        {
        case spv::Op::OpTypeInt:
        case spv::Op::OpTypeFloat:
        {
            const std::uint32_t bytes = m_module.operand(type, 0) / 8;
            return {bytes, std::max(bytes, 1u)};
        }
        case spv::Op::OpTypeVector:
        {
            const Layout component = layout(m_module.operand(type, 0), nullptr, nesting + 1);
            return {checked(component.bytes, m_module.operand(type, 1)), component.alignment};
        }
        case spv::Op::OpTypeMatrix:
        {
            const Layout column = layout(m_module.operand(type, 0), nullptr, nesting + 1);
            const std::uint32_t rows = m_module.operand(m_module.operand(type, 0), 1);
            const std::uint32_t vectors = member != nullptr && member->is_row_major ? rows : m_module.operand(type, 1);
            const std::uint32_t stride =
                member != nullptr && member->matrix_stride != 0 ? member->matrix_stride : column.bytes;
            return {checked(stride, vectors), column.alignment};
        }
        case spv::Op::OpTypeArray:
        {
            const Layout element = layout(m_module.operand(type, 0), member, nesting + 1);
            const auto stride = m_module.array_strides.find(type);
            return {checked(stride != m_module.array_strides.end() ? stride->second : element.bytes,
                            m_module.constant(m_module.operand(type, 1))),
                    element.alignment};
        }
        case spv::Op::OpTypePointer:
            return {kPointerBytes, kPointerBytes};
        case spv::Op::OpTypeStruct:
            return structLayout(type, found, nesting);
        default:
            failModule(fmt::format("its push constants hold type id {}, which has no layout", type));
        }
    }

    [[nodiscard]] Layout structLayout(std::uint32_t type, const SpirvModule::Declaration& found, int nesting) const
    {
        Layout result;
        const auto members = m_module.members.find(type);
        for (std::uint32_t i = 0; i < found.operands.size(); ++i)
        {
            SpirvModule::Member member;
            if (members != m_module.members.end() && members->second.count(i) != 0)
            {
                member = members->second.at(i);
            }
            const Layout inner = layout(found.operands[i], &member, nesting + 1);
            if (member.offset > kMaxBytes)
            {
                failModule("its push constants are too big");
            }
            result.bytes = std::max(result.bytes, member.offset + inner.bytes);
            result.alignment = std::max(result.alignment, inner.alignment);
        }
        result.bytes = (result.bytes + result.alignment - 1) / result.alignment * result.alignment;
        return result;
    }

    static std::uint32_t checked(std::uint64_t bytes, std::uint64_t count)
    {
        if (bytes > kMaxBytes || count > kMaxBytes || bytes * count > kMaxBytes)
        {
            failModule("its push constants are too big");
        }
        return static_cast<std::uint32_t>(bytes * count);
    }

    SpirvModule m_module;
};

} // namespace

KernelInterface reflectKernel(std::span<const std::uint32_t> words)
{
    return Reflection(words).interface();
}

} // namespace zvo::vk
