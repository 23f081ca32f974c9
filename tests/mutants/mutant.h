/// @file
/// What scripts/mutate puts into a copy of the product's code: every change is compiled in, and VICON_MUTANT names the
/// one that acts. Where VICON_MUTANTS_REACHED names a file of zeros, each place that was come by is marked in it.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>
#include <functional>
#include <type_traits>

#include <cstdlib>

namespace mutant {
inline constexpr int kMost = 4096;
inline constexpr unsigned char kReached = 1;
inline constexpr unsigned char kNoSuchChange = 2;  ///< the types have no such operator: not a mutant

inline int active()
{
    static const int number = [] {
        const char* text = std::getenv("VICON_MUTANT");
        return text ? std::atoi(text) : -1;
    }();
    return number;
}

inline unsigned char* marks()
{
    static unsigned char nowhere[kMost];
    static unsigned char* const bytes = [] {
        const char* path = std::getenv("VICON_MUTANTS_REACHED");
        const int file = path ? ::open(path, O_RDWR | O_CLOEXEC) : -1;
        void* mapped = file < 0 ? MAP_FAILED : ::mmap(nullptr, kMost, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
        if (file >= 0)
            ::close(file);
        return mapped == MAP_FAILED ? nowhere : static_cast<unsigned char*>(mapped);
    }();
    return bytes;
}

/// Whether change `number` acts. Never while the compiler computes.
constexpr bool on(int number)
{
    if (std::is_constant_evaluated())
        return false;
    marks()[number] = kReached;
    return active() == number;
}

template <int kNumber, class Was, class Becomes>
struct Operation {
    template <class A, class B>
    static constexpr decltype(auto) of(const A& a, const B& b)
    {
        using Result = std::decay_t<decltype(Was{}(a, b))>;
        if constexpr (requires { static_cast<Result>(Becomes{}(a, b)); })
            return on(kNumber) ? static_cast<Result>(Becomes{}(a, b)) : static_cast<Result>(Was{}(a, b));
        else {
            if (!std::is_constant_evaluated())
                marks()[kNumber] = kNoSuchChange;
            return static_cast<Result>(Was{}(a, b));
        }
    }
};

/// The left side of an operation, waiting for its right one.
template <class A, class Operation>
struct Left {
    const A& a;
};

template <int kNumber, class Was, class Becomes>
struct Infix {
};

#define MUTANT_INFIX(sign)                                                 \
    template <class A, int kNumber, class Was, class Becomes>              \
    constexpr auto operator sign(const A& a, Infix<kNumber, Was, Becomes>) \
    {                                                                      \
        return Left<A, Operation<kNumber, Was, Becomes>>{a};               \
    }                                                                      \
    template <class A, class B, class O>                                   \
    constexpr auto operator sign(Left<A, O> left, const B& b)              \
    {                                                                      \
        return O::of(left.a, b);                                           \
    }
MUTANT_INFIX(<)
MUTANT_INFIX(<=)
MUTANT_INFIX(>)
MUTANT_INFIX(>=)
MUTANT_INFIX(==)
MUTANT_INFIX(!=)
MUTANT_INFIX(+)
MUTANT_INFIX(-)
MUTANT_INFIX(*)
#undef MUTANT_INFIX

using Less = std::less<>;
using LessEqual = std::less_equal<>;
using Greater = std::greater<>;
using GreaterEqual = std::greater_equal<>;
using Equal = std::equal_to<>;
using NotEqual = std::not_equal_to<>;
using Plus = std::plus<>;
using Minus = std::minus<>;
using Times = std::multiplies<>;
using Over = std::divides<>;

/// `a && Dropped<1>{} | b` is `a && b`, and `a` while change 1 acts.
template <int kNumber>
struct DroppedFromAnd {
    template <class B>
    friend constexpr bool operator|(DroppedFromAnd, const B& b)
    {
        return static_cast<bool>(b) || on(kNumber);
    }
};

template <int kNumber>
struct DroppedFromOr {
    template <class B>
    friend constexpr bool operator&(DroppedFromOr, const B& b)
    {
        return static_cast<bool>(b) && !on(kNumber);
    }
};

template <int kNumber, class T>
constexpr T min(const T& a, const T& b)
{
    return (b < a) != on(kNumber) ? b : a;
}

template <int kNumber, class T>
constexpr T max(const T& a, const T& b)
{
    return (a < b) != on(kNumber) ? b : a;
}

}  // namespace mutant
