/* Has this processor what the compiler built for?
 *
 * fpm.toml compiles for the processor at hand, and a build may be carried to another one. There its
 * first instruction that is missing would end the program by SIGILL, without a word. So this asks
 * before anything else runs, Fortran's start included, in instructions that all processors have.
 * Fortran cannot ask: the compiler says what it builds for by macros. */
#include <stddef.h>
#include <string.h>
#include <unistd.h>

const char *lagrangia_missing_feature(void);
char lagrangia_vector_unit(int i);

#if defined(__x86_64__) && defined(__GNUC__)
#define PLAIN __attribute__((target("general-regs-only,no-bmi,no-bmi2,no-lzcnt,no-popcnt"), noinline))
#define NEED(name, text) \
    if (!__builtin_cpu_supports(name)) return text

/* The first feature that this file was compiled for and the processor lacks; NULL if there is none. */
PLAIN const char *lagrangia_missing_feature(void)
{
    __builtin_cpu_init();
#ifdef __FMA4__
    NEED("fma4", "FMA4");
#endif
#ifdef __AVX512F__
    NEED("avx512f", "AVX-512");
#endif
#ifdef __AVX512VL__
    NEED("avx512vl", "AVX-512VL");
#endif
#ifdef __AVX512DQ__
    NEED("avx512dq", "AVX-512DQ");
#endif
#ifdef __AVX512BW__
    NEED("avx512bw", "AVX-512BW");
#endif
#ifdef __AVX512VBMI__
    NEED("avx512vbmi", "AVX-512VBMI");
#endif
#ifdef __AVX512IFMA__
    NEED("avx512ifma", "AVX-512IFMA");
#endif
#ifdef __AVX2__
    NEED("avx2", "AVX2");
#endif
#ifdef __FMA__
    NEED("fma", "FMA");
#endif
#ifdef __AVX__
    NEED("avx", "AVX");
#endif
#ifdef __BMI__
    NEED("bmi", "BMI");
#endif
#ifdef __BMI2__
    NEED("bmi2", "BMI2");
#endif
#ifdef __POPCNT__
    NEED("popcnt", "POPCNT");
#endif
#ifdef __SSE4_2__
    NEED("sse4.2", "SSE4.2");
#endif
#ifdef __SSE4_1__
    NEED("sse4.1", "SSE4.1");
#endif
#ifdef __SSSE3__
    NEED("ssse3", "SSSE3");
#endif
#ifdef __SSE3__
    NEED("sse3", "SSE3");
#endif
    return NULL;
}

PLAIN static void say(const char *text)
{
    ssize_t written = write(STDERR_FILENO, text, strlen(text));
    (void)written;
}

/* Status 4, of the surroundings. */
PLAIN __attribute__((constructor)) static void refuse(void)
{
    const char *missing = lagrangia_missing_feature();
    if (missing == NULL) return;
    say("lagrangia: this build needs a processor with ");
    say(missing);
    say("; build it again on this one: rm -rf build; fpm run\n");
    _exit(4);
}
#else
const char *lagrangia_missing_feature(void) { return NULL; }
#endif

#if defined(__AVX512F__)
#define UNIT "AVX-512"
#elif defined(__AVX2__)
#define UNIT "AVX2"
#elif defined(__AVX__)
#define UNIT "AVX"
#elif defined(__SSE2__)
#define UNIT "SSE2"
#elif defined(__ARM_FEATURE_SVE)
#define UNIT "SVE"
#elif defined(__ARM_NEON)
#define UNIT "Neon"
#else
#define UNIT "no vector unit"
#endif

/* Letter i, from 1, of the vector unit that this file was compiled for; 0 behind the last. */
char lagrangia_vector_unit(int i)
{
    return UNIT[i - 1];
}
