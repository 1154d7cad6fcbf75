# SPDX-License-Identifier: Apache-2.0
"""header_filter_test.py FOLDER: the filter of the API reference, from FOLDER, on a header with every form of comment."""
import pathlib
import sys
import tempfile

HEADER = r'''// SPDX-License-Identifier: Apache-2.0
// Lines through two points. A second sentence with <angles>, a\b, @c, #d, 50 %, a_i and *p of `code`.
//
//   P(t) = (1−t) A   + t B        laid out
//     \n and @x as they stand
//
//   * one thing,
//     that goes on;
//   * another: near.h
//
// REQUIRES  A != B.
// ENSURES   (1) P(0) = A;  (2) as (1), at
//           1: P(1) = B;
//           (3) see other.h and near.h.
// WIDTHS  Rows:
//     a      2 limbs
//     b      3 limbs
//   whenever
//   it fits.
#pragma once

#include <vector>  // not a description

namespace patchproof {

// The kinds.
enum class Kind {
  // Flat ones:
  line,   // straight
  plane,  // flat,
          // in space
  // A solid.
  solid
};

namespace detail {
// Not shown.
int hidden();
}  // namespace detail

// Beside nothing.

struct Bare {
  int a = 0, b{1};  // both
  int c;            // one
  // Of three.
  double *p, q[2], r;
};

// ---- Construction ----------------------------

class Line {  // only these two
 public:
  // The point at t. REQUIRES t finite.
  double at(double t) const {
    // in a body
    return t;  // also
  }
  int size() const { return 2; }  // always 2
  /// \param t the parameter
  double speed(double t) const;

 private:
  // Private.
  int a_;  // too
};

/** In the manner
 *  of C. */
template <class T, int N = (1 > 0)>
void c_function(std::vector<T> x, int y);
void other(int x);  // never \throws
// clang-format off
int formatted();
// clang-format on

// ---------------------------------------------------------------------------------------------------------------------

// Of the implementation.
template <class T, int N>
void c_function(std::vector<T>, int) {}

}  // namespace patchproof
'''
FILTERED = r'''/** \defgroup spline_line spline/line.h
\brief Lines through two points. \details <p>A second sentence with &lt;angles&gt;, a\\b, \@c, \#d, 50 \%, a_i⤶
 and \*p of <code>code</code>.</p>\verbatim P(t) = (1−t) A   + t B        laid out
  \n and @x as they stand\endverbatim <ul><li>one thing, that goes on;</li><li>another: \ref spline_near "near.h"</li></ul>⤶
<dl><dt>REQUIRES</dt><dd>A != B.</dd>⤶
<dt>ENSURES</dt><dd><ul class="laws"><li>(1) P(0) = A;</li><li>(2) as (1), at 1: P(1) = B;</li>⤶
<li>(3) see other.h and \ref spline_near "near.h".</li></ul></dd>⤶
<dt>WIDTHS</dt><dd>Rows:\verbatim a      2 limbs
b      3 limbs\endverbatim whenever it fits.</dd></dl>
\ingroup spline















 */
#include <vector>  // not a description

namespace patchproof { /** \addtogroup spline_line
@{ */ 
/** \brief The kinds. */
enum class Kind {
  // Flat ones:
  line,   /**< \brief straight */
  plane,  /**< \brief flat, in space
 */
  /** \brief A solid. */
  solid
};

namespace detail {
// Not shown.
int hidden();
}  // namespace detail

// Beside nothing.

/** \details See \ref spline_line. */ struct Bare {
   /** \brief both */ int a = 0, /** \brief both */  b{1};  
  int c;            /**< \brief one */
  /** \brief Of three. */
  double *p, /** \brief Of three. */  q[2], /** \brief Of three. */  r;
};

 //! \name Construction
//! @{
 /** \brief only these two */ class Line {  
 public:
  /** \brief The point at t. \details <p><b>REQUIRES</b> t finite.</p> */
  double at(double t) const {
    // in a body
    return t;  // also
  }
  int size() const { return 2; }  /**< \brief always 2 */
  /// \param t the parameter
  double speed(double t) const;

 private:
  // Private.
  int a_;  // too
};

/** \brief In the manner of C.
 */
template <class T, int N = (1 > 0)>
void c_function(std::vector<T> x, int y);
void other(int x);  /**< \brief never \\throws */
// clang-format off
int formatted();
// clang-format on








/** @} */
/** @} */ }
/** \file patchproof/spline/line.h
\brief Lines through two points.
\details See \ref spline_line. */
'''.replace("⤶\n", "")  # lines that are longer than this file's


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.path.insert(0, sys.argv[1])
    from header_filter import Filter
    with tempfile.TemporaryDirectory() as folder:
        room = pathlib.Path(folder) / "include" / "patchproof" / "spline"
        room.mkdir(parents=True)
        (room / "near.h").write_text("#pragma once\n")
        (room / "line.h").write_text(HEADER, encoding="utf-8")
        got = Filter(room / "line.h").filtered()
    pairs = enumerate(zip(FILTERED.split("\n"), got.split("\n")), 1)
    failures = [f"line {i}:\n  expected {e!r}\n  got      {g!r}" for i, (e, g) in pairs if e != g]
    for text in ("class Line", "double speed", "int formatted"):  # warnings have to name the line of the header
        places = [[i for i, line in enumerate(lines.split("\n")) if text in line] for lines in (HEADER, got)]
        if places[0] != places[1]:
            failures.append(f"{text}: in line {places[0]} of the header, {places[1]} of the result")
    if len(FILTERED) != len(got):
        failures.append(f"{len(FILTERED)} characters expected, got {len(got)}")
    print("\n".join(failures) if failures else "the filter does what it says")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
