// SPDX-License-Identifier: MIT
// Reflects a kernel's SPIR-V (Khronos SPIR-V specification 1.6, section 2.3).
#include "vk/kernel.h"

#include "zvo/error.h"

#include <fmt/format.h>
#include <spirv/unified1/spirv.hpp11>

#include <algorithm>
#include <optional>

namespace zvo::vk
{

namespace
{

constexpr std::uint32_t kHeaderWords = 5;
constexpr std::uint32_t kPointerBytes = 8;
constexpr std::uint32_t kMaxBytes = 1 << 20; // far above any push constant block; keeps broken modules from overflowing
constexpr int kMaxNesting = 32;

struct Layout
{
    std::uint32_t bytes = 0;
    std::uint32_t alignment = 1;
};

struct Member
{
    std::uint32_t offset = 0;
    std::uint32_t matrix_stride = 0;
    bool row_major = false;
};

[[noreturn]] void fail(const std::string& what)
{
    throw Error(ErrorCode::Other, "the SPIR-V module is not a kernel: " + what);
}

// The declarations of a module that are needed here, by result id.
class Module
{
public:
    explicit Module(std::span<const std::uint32_t> words)
    {
        if (words.size() < kHeaderWords || words[0] != spv::MagicNumber)
        {
            fail("it does not start with the SPIR-V header");
        }
        std::size_t at = kHeaderWords;
        while (at < words.size())
        {
            const std::uint32_t length = words[at] >> spv::WordCountShift;
            if (length == 0 || length > words.size() - at)
            {
                fail(fmt::format("the instruction at word {} does not fit", at));
            }
            visit(static_cast<spv::Op>(words[at] & spv::OpCodeMask), words.subspan(at + 1, length - 1));
            at += length;
        }
    }

    KernelInterface interface() const
    {
        if (m_entry_points != 1)
        {
            fail(fmt::format("it has {} compute entry points instead of one", m_entry_points));
        }
        KernelInterface result;
        readLocalSize(result);
        if (m_push_constants)
        {
            const Layout block = layout(pointee(*m_push_constants), nullptr, 0);
            result.push_constant_bytes = block.bytes;
            result.params_name = onlyMemberName(pointee(*m_push_constants));
        }
        for (const auto& [id, spec_id] : m_spec_ids)
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
    struct Declaration
    {
        spv::Op op{};
        std::span<const std::uint32_t> operands; // without the result id; for constants: the type, then the values
    };

    void visit(spv::Op op, std::span<const std::uint32_t> operands)
    {
        const auto need = [&](std::size_t count)
        {
            if (operands.size() < count)
            {
                fail("an instruction is too short");
            }
        };
        switch (op)
        {
        case spv::Op::OpName:
            need(2);
            m_names[operands[0]] = operands.subspan(1);
            break;
        case spv::Op::OpEntryPoint:
            need(2);
            m_entry_points += static_cast<spv::ExecutionModel>(operands[0]) == spv::ExecutionModel::GLCompute ? 1 : 0;
            break;
        case spv::Op::OpExecutionMode:
        case spv::Op::OpExecutionModeId:
            need(2);
            visitExecutionMode(static_cast<spv::ExecutionMode>(operands[1]), operands.subspan(2));
            break;
        case spv::Op::OpDecorate:
            need(2);
            visitDecoration(operands[0], static_cast<spv::Decoration>(operands[1]), operands.subspan(2));
            break;
        case spv::Op::OpMemberDecorate:
            need(3);
            visitMemberDecoration(m_members[operands[0]][operands[1]], static_cast<spv::Decoration>(operands[2]),
                                  operands.subspan(3));
            break;
        case spv::Op::OpTypeInt:
        case spv::Op::OpTypeFloat:
        case spv::Op::OpTypeVector:
        case spv::Op::OpTypeMatrix:
        case spv::Op::OpTypeArray:
        case spv::Op::OpTypeStruct:
        case spv::Op::OpTypePointer:
        case spv::Op::OpTypeBool:
            need(1);
            m_declarations[operands[0]] = {op, operands.subspan(1)};
            break;
        case spv::Op::OpConstant:
        case spv::Op::OpSpecConstant:
        case spv::Op::OpSpecConstantTrue:
        case spv::Op::OpSpecConstantFalse:
        case spv::Op::OpConstantComposite:
        case spv::Op::OpSpecConstantComposite:
            need(2);
            m_constants[operands[1]] = operands.subspan(2);
            m_declarations[operands[1]] = {op, operands.subspan(0, 1)};
            break;
        case spv::Op::OpVariable:
            need(3);
            if (static_cast<spv::StorageClass>(operands[2]) == spv::StorageClass::PushConstant)
            {
                m_push_constants = operands[0];
            }
            break;
        default:
            break;
        }
    }

    void visitExecutionMode(spv::ExecutionMode mode, std::span<const std::uint32_t> operands)
    {
        if (mode == spv::ExecutionMode::LocalSize || mode == spv::ExecutionMode::LocalSizeId)
        {
            if (operands.size() < 3)
            {
                fail("its local size has less than three dimensions");
            }
            m_local_size = operands;
            m_local_size_by_id = mode == spv::ExecutionMode::LocalSizeId;
        }
    }

    void visitDecoration(std::uint32_t target, spv::Decoration decoration, std::span<const std::uint32_t> operands)
    {
        if (operands.empty())
        {
            return;
        }
        if (decoration == spv::Decoration::SpecId)
        {
            m_spec_ids[target] = operands[0];
        }
        else if (decoration == spv::Decoration::ArrayStride)
        {
            m_array_strides[target] = operands[0];
        }
        else if (decoration == spv::Decoration::BuiltIn &&
                 static_cast<spv::BuiltIn>(operands[0]) == spv::BuiltIn::WorkgroupSize)
        {
            m_workgroup_size = target;
        }
    }

    static void visitMemberDecoration(Member& member, spv::Decoration decoration,
                                      std::span<const std::uint32_t> operands)
    {
        if (decoration == spv::Decoration::RowMajor)
        {
            member.row_major = true;
        }
        else if (decoration == spv::Decoration::Offset && !operands.empty())
        {
            member.offset = operands[0];
        }
        else if (decoration == spv::Decoration::MatrixStride && !operands.empty())
        {
            member.matrix_stride = operands[0];
        }
    }

    void readLocalSize(KernelInterface& result) const
    {
        // The WorkgroupSize built-in takes precedence over the execution mode.
        std::span<const std::uint32_t> sizes = m_local_size;
        bool by_id = m_local_size_by_id;
        const auto built_in = m_constants.find(m_workgroup_size);
        if (built_in != m_constants.end())
        {
            sizes = built_in->second;
            by_id = true;
        }
        if (sizes.size() < result.local_size.size())
        {
            fail("it has no local size");
        }
        for (std::size_t i = 0; i < result.local_size.size(); ++i)
        {
            result.local_size[i] = by_id ? constant(sizes[i]) : sizes[i];
            const auto spec_id = m_spec_ids.find(sizes[i]);
            if (by_id && spec_id != m_spec_ids.end())
            {
                result.local_size_ids[i] = spec_id->second;
            }
        }
    }

    [[nodiscard]] const Declaration& declaration(std::uint32_t id) const
    {
        const auto found = m_declarations.find(id);
        if (found == m_declarations.end())
        {
            fail(fmt::format("id {} is not declared as a type that a push constant block can hold", id));
        }
        return found->second;
    }

    // The operand at index of id's declaration.
    [[nodiscard]] std::uint32_t operand(std::uint32_t id, std::size_t index) const
    {
        const Declaration& found = declaration(id);
        if (index >= found.operands.size())
        {
            fail(fmt::format("the declaration of id {} is too short", id));
        }
        return found.operands[index];
    }

    [[nodiscard]] std::uint32_t constant(std::uint32_t id) const
    {
        const auto found = m_constants.find(id);
        if (found == m_constants.end() || found->second.empty())
        {
            fail(fmt::format("id {} is not a constant", id));
        }
        return found->second[0];
    }

    [[nodiscard]] std::uint32_t pointee(std::uint32_t pointer_type) const { return operand(pointer_type, 1); }

    // Decodes a string: UTF-8, four bytes a word, first byte lowest, zero-terminated.
    [[nodiscard]] std::string name(std::uint32_t id) const
    {
        std::string result;
        const auto found = m_names.find(id);
        for (std::size_t i = 0; found != m_names.end() && i < 4 * found->second.size(); ++i)
        {
            const char letter = static_cast<char>(found->second[i / 4] >> (8 * (i % 4)));
            if (letter == '\0')
            {
                break;
            }
            result += letter;
        }
        return result;
    }

    [[nodiscard]] std::string onlyMemberName(std::uint32_t block) const
    {
        const Declaration& found = declaration(block);
        return found.op == spv::Op::OpTypeStruct && found.operands.size() == 1 ? name(found.operands[0]) : "";
    }

    [[nodiscard]] ModuleConstant specializationConstant(std::uint32_t id, std::uint32_t spec_id) const
    {
        ModuleConstant result{spec_id, name(id), ConstantType::Other, 0};
        const auto constant = m_constants.find(id);
        if (constant == m_constants.end())
        {
            return result;
        }
        const std::uint32_t type = operand(id, 0);
        const spv::Op type_op = declaration(type).op;
        if (type_op == spv::Op::OpTypeBool)
        {
            result.type = ConstantType::Bool;
            result.value = declaration(id).op == spv::Op::OpSpecConstantTrue ? 1 : 0;
            return result;
        }
        if (operand(type, 0) != 32)
        {
            fail(fmt::format("specialization constant {} is not 32 bits wide", spec_id));
        }
        if (type_op == spv::Op::OpTypeInt)
        {
            result.type = operand(type, 1) == 0 ? ConstantType::Uint : ConstantType::Int;
        }
        result.value = this->constant(id);
        return result;
    }

    // Size with tail padding, and alignment, by the rules of the scalar layout, which equal those of C++.
    [[nodiscard]] Layout layout(std::uint32_t type, const Member* member, int nesting) const
    {
        if (nesting > kMaxNesting)
        {
            fail("its push constants nest too deep");
        }
        const Declaration& found = declaration(type);
        switch (found.op)
        {
        case spv::Op::OpTypeInt:
        case spv::Op::OpTypeFloat:
        {
            const std::uint32_t bytes = operand(type, 0) / 8;
            return {bytes, std::max(bytes, 1u)};
        }
        case spv::Op::OpTypeVector:
        {
            const Layout component = layout(operand(type, 0), nullptr, nesting + 1);
            return {checked(component.bytes, operand(type, 1)), component.alignment};
        }
        case spv::Op::OpTypeMatrix:
        {
            const Layout column = layout(operand(type, 0), nullptr, nesting + 1);
            const std::uint32_t rows = operand(operand(type, 0), 1);
            const std::uint32_t vectors = member != nullptr && member->row_major ? rows : operand(type, 1);
            const std::uint32_t stride =
                member != nullptr && member->matrix_stride != 0 ? member->matrix_stride : column.bytes;
            return {checked(stride, vectors), column.alignment};
        }
        case spv::Op::OpTypeArray:
        {
            const Layout element = layout(operand(type, 0), member, nesting + 1);
            const auto stride = m_array_strides.find(type);
            return {
                checked(stride != m_array_strides.end() ? stride->second : element.bytes, constant(operand(type, 1))),
                element.alignment};
        }
        case spv::Op::OpTypePointer:
            return {kPointerBytes, kPointerBytes};
        case spv::Op::OpTypeStruct:
            return structLayout(type, found, nesting);
        default:
            fail(fmt::format("its push constants hold type id {}, which has no layout", type));
        }
    }

    [[nodiscard]] Layout structLayout(std::uint32_t type, const Declaration& found, int nesting) const
    {
        Layout result;
        const auto members = m_members.find(type);
        for (std::uint32_t i = 0; i < found.operands.size(); ++i)
        {
            Member member;
            if (members != m_members.end() && members->second.count(i) != 0)
            {
                member = members->second.at(i);
            }
            const Layout inner = layout(found.operands[i], &member, nesting + 1);
            if (member.offset > kMaxBytes)
            {
                fail("its push constants are too big");
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
            fail("its push constants are too big");
        }
        return static_cast<std::uint32_t>(bytes * count);
    }

    std::map<std::uint32_t, std::span<const std::uint32_t>> m_names;
    std::uint32_t m_entry_points = 0;
    std::span<const std::uint32_t> m_local_size;
    bool m_local_size_by_id = false;
    std::uint32_t m_workgroup_size = 0;            // id of the constant with the built-in; 0: none
    std::optional<std::uint32_t> m_push_constants; // type of the pointer to the block
    std::map<std::uint32_t, Declaration> m_declarations;
    std::map<std::uint32_t, std::span<const std::uint32_t>> m_constants;
    std::map<std::uint32_t, std::uint32_t> m_spec_ids; // constant -> SpecId
    std::map<std::uint32_t, std::uint32_t> m_array_strides;
    std::map<std::uint32_t, std::map<std::uint32_t, Member>> m_members; // struct -> member index -> layout
};

} // namespace

KernelInterface reflectKernel(std::span<const std::uint32_t> words)
{
    return Module(words).interface();
}

} // namespace zvo::vk
