// SPDX-License-Identifier: Apache-2.0
// What GMP reads and writes, told to ThreadSanitizer: GMP itself is not compiled for it. The linker puts these functions in
// front of GMP's (tests/threads/CMakeLists.txt lists the same names, or the program does not link), so that a number which a
// call changes although it is shared is a race like any other.
#include <gmp.h>

#include <cstdlib>

extern "C" void __tsan_read_range(void* begin, unsigned long size);
extern "C" void __tsan_write_range(void* begin, unsigned long size);

namespace {

void reads(const __mpz_struct* x) { __tsan_read_range(x->_mp_d, std::abs(x->_mp_size) * sizeof(mp_limb_t)); }
void reads(const __mpq_struct* x) { reads(&x->_mp_num), reads(&x->_mp_den); }
template <class T>
void writes(T* x) {
  __tsan_write_range(x, sizeof(T));
}

}  // namespace

#define PATCHPROOF_FROM_TWO(T, name)                                 \
  extern "C" void __real___gmp##name(T*, const T*, const T*);        \
  extern "C" void __wrap___gmp##name(T* w, const T* u, const T* v) { \
    reads(u), reads(v), writes(w);                                   \
    __real___gmp##name(w, u, v);                                     \
  }
#define PATCHPROOF_FROM_ONE_AND_WORD(R, T, name)                       \
  extern "C" R __real___gmp##name(T*, const T*, unsigned long);        \
  extern "C" R __wrap___gmp##name(T* w, const T* u, unsigned long v) { \
    reads(u), writes(w);                                               \
    return __real___gmp##name(w, u, v);                                \
  }
#define PATCHPROOF_TWO_FROM(T, name)                                       \
  extern "C" void __real___gmp##name(T*, T*, const T*, const T*);          \
  extern "C" void __wrap___gmp##name(T* q, T* r, const T* u, const T* v) { \
    reads(u), reads(v), writes(q), writes(r);                              \
    __real___gmp##name(q, r, u, v);                                        \
  }
#define PATCHPROOF_COPIES(T, U, name)                    \
  extern "C" void __real___gmp##name(T*, const U*);      \
  extern "C" void __wrap___gmp##name(T* w, const U* u) { \
    reads(u), writes(w);                                 \
    __real___gmp##name(w, u);                            \
  }
#define PATCHPROOF_SWAPS(T, name)                  \
  extern "C" void __real___gmp##name(T*, T*);      \
  extern "C" void __wrap___gmp##name(T* u, T* v) { \
    writes(u), writes(v);                          \
    __real___gmp##name(u, v);                      \
  }
#define PATCHPROOF_COMPARES(T, name)                          \
  extern "C" int __real___gmp##name(const T*, const T*);      \
  extern "C" int __wrap___gmp##name(const T* u, const T* v) { \
    reads(u), reads(v);                                       \
    return __real___gmp##name(u, v);                          \
  }
#define PATCHPROOF_PRINTS(T, name)                                        \
  extern "C" char* __real___gmp##name(char*, int, const T*);              \
  extern "C" char* __wrap___gmp##name(char* text, int base, const T* u) { \
    reads(u);                                                             \
    return __real___gmp##name(text, base, u);                             \
  }
#define PATCHPROOF_ROUNDS(T, name)                   \
  extern "C" double __real___gmp##name(const T*);    \
  extern "C" double __wrap___gmp##name(const T* u) { \
    reads(u);                                        \
    return __real___gmp##name(u);                    \
  }
#define PATCHPROOF_CHANGES(T, name)          \
  extern "C" void __real___gmp##name(T*);    \
  extern "C" void __wrap___gmp##name(T* w) { \
    writes(w);                               \
    __real___gmp##name(w);                   \
  }

PATCHPROOF_FROM_TWO(__mpq_struct, q_add)
PATCHPROOF_FROM_TWO(__mpq_struct, q_sub)
PATCHPROOF_FROM_TWO(__mpq_struct, q_mul)
PATCHPROOF_FROM_TWO(__mpq_struct, q_div)
PATCHPROOF_FROM_ONE_AND_WORD(void, __mpq_struct, q_mul_2exp)
PATCHPROOF_FROM_ONE_AND_WORD(void, __mpq_struct, q_div_2exp)
PATCHPROOF_COPIES(__mpq_struct, __mpq_struct, q_set)
PATCHPROOF_COPIES(__mpq_struct, __mpz_struct, q_set_z)
PATCHPROOF_SWAPS(__mpq_struct, q_swap)
PATCHPROOF_COMPARES(__mpq_struct, q_cmp)
PATCHPROOF_PRINTS(__mpq_struct, q_get_str)
PATCHPROOF_ROUNDS(__mpq_struct, q_get_d)
PATCHPROOF_CHANGES(__mpq_struct, q_canonicalize)

PATCHPROOF_FROM_TWO(__mpz_struct, z_add)
PATCHPROOF_FROM_TWO(__mpz_struct, z_sub)
PATCHPROOF_FROM_TWO(__mpz_struct, z_mul)
PATCHPROOF_FROM_TWO(__mpz_struct, z_and)
PATCHPROOF_FROM_TWO(__mpz_struct, z_divexact)
PATCHPROOF_FROM_TWO(__mpz_struct, z_gcd)
PATCHPROOF_FROM_TWO(__mpz_struct, z_lcm)
PATCHPROOF_FROM_TWO(__mpz_struct, z_tdiv_q)
PATCHPROOF_FROM_TWO(__mpz_struct, z_tdiv_r)
PATCHPROOF_TWO_FROM(__mpz_struct, z_tdiv_qr)
PATCHPROOF_FROM_ONE_AND_WORD(void, __mpz_struct, z_add_ui)
PATCHPROOF_FROM_ONE_AND_WORD(void, __mpz_struct, z_sub_ui)
PATCHPROOF_FROM_ONE_AND_WORD(void, __mpz_struct, z_mul_ui)
PATCHPROOF_FROM_ONE_AND_WORD(void, __mpz_struct, z_mul_2exp)
PATCHPROOF_FROM_ONE_AND_WORD(unsigned long, __mpz_struct, z_tdiv_r_ui)
PATCHPROOF_COPIES(__mpz_struct, __mpz_struct, z_set)
PATCHPROOF_SWAPS(__mpz_struct, z_swap)
PATCHPROOF_COMPARES(__mpz_struct, z_cmp)
PATCHPROOF_PRINTS(__mpz_struct, z_get_str)
PATCHPROOF_ROUNDS(__mpz_struct, z_get_d)
