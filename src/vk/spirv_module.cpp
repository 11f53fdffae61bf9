// SPDX-License-Identifier: MIT
#include "vk/spirv_module.h"

#include "zvo/error.h"

#include <fmt/format.h>

namespace zvo::vk
{

constexpr std::uint32_t kHeaderWords = 5;

void failModule(const std::string& what)
{
    throw Error(ErrorCode::Other, "the SPIR-V module is not a kernel: " + what);
}

SpirvModule::SpirvModule(std::span<const std::uint32_t> words)
{
    if (words.size() < kHeaderWords || words[0] != spv::MagicNumber)
    {
        failModule("it does not start with the SPIR-V header");
    }
    std::size_t at = kHeaderWords;
    while (at < words.size())
    {
        const std::uint32_t length = words[at] >> spv::WordCountShift;
        if (length == 0 || length > words.size() - at)
        {
            failModule(fmt::format("the instruction at word {} does not fit", at));
        }
        visit(static_cast<spv::Op>(words[at] & spv::OpCodeMask), words.subspan(at + 1, length - 1));
        at += length;
    }
}

void SpirvModule::visit(spv::Op op, std::span<const std::uint32_t> operands)
{
    const auto need = [&](std::size_t count)
    {
        if (operands.size() < count)
        {
            failModule("an instruction is too short");
        }
    };
    switch (op)
    {
    case spv::Op::OpName:
        need(2);
        m_names[operands[0]] = operands.subspan(1);
        break;
    case spv::Op::OpMemberName:
        need(3);
        m_member_names[{operands[0], operands[1]}] = operands.subspan(2);
        break;
    case spv::Op::OpEntryPoint:
        need(2);
        entry_point_count += static_cast<spv::ExecutionModel>(operands[0]) == spv::ExecutionModel::GLCompute ? 1 : 0;
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
        visitMemberDecoration(members[operands[0]][operands[1]], static_cast<spv::Decoration>(operands[2]),
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
        constants[operands[1]] = operands.subspan(2);
        m_declarations[operands[1]] = {op, operands.subspan(0, 1)};
        break;
    case spv::Op::OpVariable:
        need(3);
        visitVariable(operands[1], operands[0], static_cast<spv::StorageClass>(operands[2]));
        break;
    default:
        break;
    }
}

void SpirvModule::visitVariable(std::uint32_t id, std::uint32_t type, spv::StorageClass storage)
{
    switch (storage)
    {
    case spv::StorageClass::PushConstant:
        push_constants = type;
        break;
    case spv::StorageClass::UniformConstant:
    case spv::StorageClass::Uniform:
    case spv::StorageClass::StorageBuffer:
        resources.push_back({id, storage});
        break;
    default:
        break;
    }
}

void SpirvModule::visitExecutionMode(spv::ExecutionMode mode, std::span<const std::uint32_t> operands)
{
    if (mode == spv::ExecutionMode::LocalSize || mode == spv::ExecutionMode::LocalSizeId)
    {
        if (operands.size() < 3)
        {
            failModule("its local size has less than three dimensions");
        }
        local_size = operands;
        is_local_size_by_id = mode == spv::ExecutionMode::LocalSizeId;
    }
}

void SpirvModule::visitDecoration(std::uint32_t target, spv::Decoration decoration,
                                  std::span<const std::uint32_t> operands)
{
    if (operands.empty())
    {
        return;
    }
    if (decoration == spv::Decoration::SpecId)
    {
        spec_ids[target] = operands[0];
    }
    else if (decoration == spv::Decoration::ArrayStride)
    {
        array_strides[target] = operands[0];
    }
    else if (decoration == spv::Decoration::Binding)
    {
        bindings[target] = operands[0];
    }
    else if (decoration == spv::Decoration::DescriptorSet)
    {
        descriptor_sets[target] = operands[0];
    }
    else if (decoration == spv::Decoration::BuiltIn &&
             static_cast<spv::BuiltIn>(operands[0]) == spv::BuiltIn::WorkgroupSize)
    {
        workgroup_size = target;
    }
}

void SpirvModule::visitMemberDecoration(Member& member, spv::Decoration decoration,
                                        std::span<const std::uint32_t> operands)
{
    if (decoration == spv::Decoration::RowMajor)
    {
        member.is_row_major = true;
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

const SpirvModule::Declaration& SpirvModule::declaration(std::uint32_t id) const
{
    const auto found = m_declarations.find(id);
    if (found == m_declarations.end())
    {
        failModule(fmt::format("id {} is not declared as a type that a push constant block can hold", id));
    }
    return found->second;
}

// The type that id's declaration m_names at index, or its number there.
std::uint32_t SpirvModule::operand(std::uint32_t id, std::size_t index) const
{
    const Declaration& found = declaration(id);
    if (index >= found.operands.size())
    {
        failModule(fmt::format("the declaration of id {} is too short", id));
    }
    return found.operands[index];
}

std::uint32_t SpirvModule::constant(std::uint32_t id) const
{
    const auto found = constants.find(id);
    if (found == constants.end() || found->second.empty())
    {
        failModule(fmt::format("id {} is not a constant", id));
    }
    return found->second[0];
}

std::string SpirvModule::name(std::uint32_t id) const
{
    const auto found = m_names.find(id);
    return found != m_names.end() ? text(found->second) : "";
}

std::string SpirvModule::memberName(std::uint32_t id, std::uint32_t member) const
{
    const auto found = m_member_names.find({id, member});
    return found != m_member_names.end() ? text(found->second) : "";
}

// Strings are UTF-8, four bytes a word, first byte lowest, ended by a zero byte.
std::string SpirvModule::text(std::span<const std::uint32_t> words)
{
    std::string result;
    for (std::size_t i = 0; i < 4 * words.size(); ++i)
    {
        const char letter = static_cast<char>(words[i / 4] >> (8 * (i % 4)));
        if (letter == '\0')
        {
            break;
        }
        result += letter;
    }
    return result;
}

} // namespace zvo::vk
