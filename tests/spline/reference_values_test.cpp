// SPDX-License-Identifier: Apache-2.0
// Values and first two derivatives of the curves of "Curves, surfaces and splines with LAR", and of conic arcs, worked out
// by another program that shares no code with this library; exact, from both sides at knots.
#include <gtest/gtest.h>

#include <sstream>

#include "patchproof/spline/bspline_basis.h"
#include "patchproof/spline/conic.h"
#include "patchproof/spline/homogeneous.h"
#include "support/lar_curves.h"

namespace patchproof::test {
namespace {

// name t side | point | first derivative | second derivative;  side R, L, or b for both.
const char* const polynomial_rows = R"(
test01 0 b | 0 0 | 4 0 | -12 12
test01 1/5 b | 387/625 113/625 | 308/125 192/125 | -96/25 96/25
test01 1/3 b | 25/27 11/27 | 20/9 16/9 | 0 0
test01 1/2 b | 21/16 11/16 | 5/2 3/2 | 3 -3
test01 3/4 b | 525/256 243/256 | 55/16 9/16 | 15/4 -15/4
test01 31/32 b | 3014781/1048576 1048451/1048576 | 32675/8192 93/8192 | 183/256 -183/256
test01 1 b | 3 1 | 4 0 | 0 0
test08a 0 R | 0 0 | -3 6 | 12 -6
test08a 1/3 R | -34/81 136/81 | 2/9 37/9 | 22/3 -16/3
test08a 1/2 R | -7/24 55/24 | 5/4 13/4 | 5 -5
test08a 1 b | 2/3 10/3 | 2 1 | -2 -4
test08a 4/3 R | 11/9 187/54 | 4/3 -1/6 | -2 -3
test08a 3/2 R | 17/12 163/48 | 1 -5/8 | -2 -5/2
test08a 2 b | 5/3 17/6 | 0 -3/2 | -2 -1
test08a 7/3 R | 85/54 373/162 | -1/2 -29/18 | -1 1/3
test08a 5/2 R | 71/48 49/24 | -5/8 -3/2 | -1/2 1
test08a 3 b | 7/6 3/2 | -1/2 -1/2 | 1 3
test08a 10/3 R | 343/324 119/81 | -5/36 2/9 | 7/6 4/3
test08a 7/2 R | 101/96 73/48 | 1/16 3/8 | 5/4 1/2
test08a 4 b | 5/4 5/3 | 3/4 0 | 3/2 -2
test08a 13/3 R | 169/108 257/162 | 13/12 -7/18 | 1/2 -1/3
test08a 9/2 R | 7/4 73/48 | 9/8 -3/8 | 0 1/2
test08a 5 b | 9/4 3/2 | 3/4 1/2 | -3/2 3
test08a 16/3 R | 527/216 587/324 | 11/24 47/36 | -1/4 11/6
test08a 11/2 R | 161/64 197/96 | 15/32 25/16 | 3/8 5/4
test08a 6 b | 23/8 35/12 | 9/8 7/4 | 9/4 -1/2
test08a 19/3 R | 91/27 268/81 | 11/6 1/9 | 2 -28/3
test08a 13/2 R | 237/64 305/96 | 69/32 -29/16 | 15/8 -55/4
test08a 7 L | 5 0 | 3 -12 | 3/2 -27
test08b 0 R | 0 1 | 2 0 | -1 -1
test08b 1/3 R | 11/18 17/18 | 5/3 -1/3 | -1 -1
test08b 1 L | 3/2 1/2 | 1 -1 | -1 -1
test08b 1 R | 3/2 1/2 | 1 -1 | 0 1
test08b 4/3 R | 11/6 2/9 | 1 -2/3 | 0 1
test08b 2 L | 5/2 0 | 1 0 | 0 1
test08b 2 R | 5/2 0 | 1 0 | 0 0
test08b 7/3 R | 17/6 0 | 1 0 | 0 0
test08b 3 L | 7/2 0 | 1 0 | 0 0
test08b 3 R | 7/2 0 | 1 0 | 0 -1
test08b 10/3 R | 23/6 -1/18 | 1 -1/3 | 0 -1
test08b 4 L | 9/2 -1/2 | 1 -1 | 0 -1
test08b 4 R | 9/2 -1/2 | 1 -1 | 1 1
test08b 13/3 R | 44/9 -7/9 | 4/3 -2/3 | 1 1
test08b 5 L | 6 -1 | 2 0 | 1 1
test09 0 b | 0 1 | 0 -3 | 6 12
test09 1/5 b | 13/125 76/125 | 24/25 -27/25 | 18/5 36/5
test09 1/3 b | 7/27 14/27 | 4/3 -1/3 | 2 4
test09 1/2 b | 1/2 1/2 | 3/2 0 | 0 0
test09 3/4 b | 27/32 7/16 | 9/8 -3/4 | -3 -6
test09 31/32 b | 16337/16384 721/8192 | 93/512 -675/256 | -45/8 -45/4
test09 1 b | 1 0 | 0 -3 | -6 -12
test10a 0 R | 0 0 | 15/2 15 | 6 -54
test10a 1/3 R | 25/9 23/9 | 9 2 | 3 -24
test10a 1/2 R | 69/16 21/8 | 75/8 -3/4 | 3/2 -9
test10a 1 L | 9 3 | 9 6 | -3 36
test10b 0 R | 0 0 | 15/2 15 | -15 -30
test10b 1/3 R | 43/24 94/27 | 29/8 19/3 | -33/4 -22
test10b 1/2 R | 147/64 17/4 | 81/32 3 | -39/8 -18
test10b 1 b | 27/8 4 | 21/8 -3 | 21/4 -6
test10b 4/3 R | 41/9 77/27 | 9/2 -10/3 | 6 4
test10b 3/2 R | 345/64 19/8 | 177/32 -9/4 | 51/8 9
test10b 2 L | 9 3 | 9 6 | 15/2 24
test10c 0 R | 0 0 | 15/2 15 | -15 -30
test10c 1/3 R | 95/54 95/27 | 10/3 20/3 | -10 -20
test10c 1/2 R | 35/16 35/8 | 15/8 15/4 | -15/2 -15
test10c 1 b | 5/2 5 | 0 0 | 0 0
test10c 4/3 R | 547/216 134/27 | 7/24 -1/3 | 7/4 -2
test10c 3/2 R | 167/64 39/8 | 21/32 -3/4 | 21/8 -3
test10c 2 b | 27/8 4 | 21/8 -3 | 21/4 -6
test10c 7/3 R | 41/9 77/27 | 9/2 -10/3 | 6 4
test10c 5/2 R | 345/64 19/8 | 177/32 -9/4 | 51/8 9
test10c 3 L | 9 3 | 9 6 | 15/2 24
test11a 0 R | 0 1 | 0 -2 | 1 2
test11a 1/3 R | 1/18 4/9 | 1/3 -4/3 | 1 2
test11a 1/2 R | 1/8 1/4 | 1/2 -1 | 1 2
test11a 1 L | 1/2 0 | 1 0 | 1 2
test11a 1 R | 1/2 0 | 1 0 | -1 1
test11a 4/3 R | 7/9 1/18 | 2/3 1/3 | -1 1
test11a 3/2 R | 7/8 1/8 | 1/2 1/2 | -1 1
test11a 2 L | 1 1/2 | 0 1 | -1 1
test11a 2 R | 1 1/2 | 0 1 | -2 -1
test11a 7/3 R | 8/9 7/9 | -2/3 2/3 | -2 -1
test11a 5/2 R | 3/4 7/8 | -1 1/2 | -2 -1
test11a 3 L | 0 1 | -2 0 | -2 -1
test11b 2 R | 0 1/2 | 0 -1 | 1 1
test11b 7/3 R | 1/18 2/9 | 1/3 -2/3 | 1 1
test11b 5/2 R | 1/8 1/8 | 1/2 -1/2 | 1 1
test11b 3 L | 1/2 0 | 1 0 | 1 1
test11b 3 R | 1/2 0 | 1 0 | -1 1
test11b 10/3 R | 7/9 1/18 | 2/3 1/3 | -1 1
test11b 7/2 R | 7/8 1/8 | 1/2 1/2 | -1 1
test11b 4 L | 1 1/2 | 0 1 | -1 1
test11b 4 R | 1 1/2 | 0 1 | -1 -1
test11b 13/3 R | 17/18 7/9 | -1/3 2/3 | -1 -1
test11b 9/2 R | 7/8 7/8 | -1/2 1/2 | -1 -1
test11b 5 L | 1/2 1 | -1 0 | -1 -1
test11c_closed 2 R | 0 1/2 | 0 -1 | 1 1
test11c_closed 7/3 R | 1/18 2/9 | 1/3 -2/3 | 1 1
test11c_closed 3 L | 1/2 0 | 1 0 | 1 1
test11c_closed 3 R | 1/2 0 | 1 0 | -1 1
test11c_closed 10/3 R | 7/9 1/18 | 2/3 1/3 | -1 1
test11c_closed 4 L | 1 1/2 | 0 1 | -1 1
test11c_closed 4 R | 1 1/2 | 0 1 | -1 -1
test11c_closed 13/3 R | 17/18 7/9 | -1/3 2/3 | -1 -1
test11c_closed 5 L | 1/2 1 | -1 0 | -1 -1
test11c_closed 5 R | 1/2 1 | -1 0 | 1 -1
test11c_closed 16/3 R | 2/9 17/18 | -2/3 -1/3 | 1 -1
test11c_closed 6 L | 0 1/2 | 0 -1 | 1 -1
test12_b1 0 R | 0 0 | -2 4 | 4 -2
test12_b1 1/3 R | -4/9 11/9 | -2/3 10/3 | 4 -2
test12_b1 1 L | 0 3 | 2 2 | 4 -2
test12_b1 1 R | 0 3 | 2 2 | -1 -3
test12_b1 4/3 R | 11/18 7/2 | 5/3 1 | -1 -3
test12_b1 2 L | 3/2 7/2 | 1 -1 | -1 -3
test12_b1 2 R | 3/2 7/2 | 1 -1 | -2 -1
test12_b1 7/3 R | 31/18 28/9 | 1/3 -4/3 | -2 -1
test12_b1 3 L | 3/2 2 | -1 -2 | -2 -1
test12_b1 3 R | 3/2 2 | -1 -2 | 1 3
test12_b1 10/3 R | 11/9 3/2 | -2/3 -1 | 1 3
test12_b1 4 L | 1 3/2 | 0 1 | 1 3
test12_b1 4 R | 1 3/2 | 0 1 | 3 -3
test12_b1 13/3 R | 7/6 5/3 | 1 0 | 3 -3
test12_b1 5 L | 5/2 1 | 3 -2 | 3 -3
test12_b2 0 R | 0 0 | -2 4 | 6 0
test12_b2 1/3 R | -1/3 4/3 | 0 4 | 6 0
test12_b2 1/2 R | -1/4 2 | 1 4 | 6 0
test12_b2 1 L | 1 4 | 4 4 | 6 0
test12_b2 1 R | 1 4 | 2 -2 | -3 0
test12_b2 4/3 R | 3/2 10/3 | 1 -2 | -3 0
test12_b2 3/2 R | 13/8 3 | 1/2 -2 | -3 0
test12_b2 2 L | 3/2 2 | -1 -2 | -3 0
test12_b2 2 R | 3/2 2 | -1 -2 | 1 3
test12_b2 7/3 R | 11/9 3/2 | -2/3 -1 | 1 3
test12_b2 5/2 R | 9/8 11/8 | -1/2 -1/2 | 1 3
test12_b2 3 L | 1 3/2 | 0 1 | 1 3
test12_b2 3 R | 1 3/2 | 0 1 | 3 -3
test12_b2 10/3 R | 7/6 5/3 | 1 0 | 3 -3
test12_b2 7/2 R | 11/8 13/8 | 3/2 -1/2 | 3 -3
test12_b2 4 L | 5/2 1 | 3 -2 | 3 -3
test12_b3 0 R | 0 0 | -2 4 | 6 0
test12_b3 1/3 R | -1/3 4/3 | 0 4 | 6 0
test12_b3 1/2 R | -1/4 2 | 1 4 | 6 0
test12_b3 1 L | 1 4 | 4 4 | 6 0
test12_b3 1 R | 2 3 | -2 -4 | 2 5
test12_b3 4/3 R | 13/9 35/18 | -4/3 -7/3 | 2 5
test12_b3 3/2 R | 5/4 13/8 | -1 -3/2 | 2 5
test12_b3 2 L | 1 3/2 | 0 1 | 2 5
test12_b3 2 R | 1 3/2 | 0 1 | 3 -3
test12_b3 7/3 R | 7/6 5/3 | 1 0 | 3 -3
test12_b3 5/2 R | 11/8 13/8 | 3/2 -1/2 | 3 -3
test12_b3 3 L | 5/2 1 | 3 -2 | 3 -3
test12_b4 0 R | 0 0 | -2 4 | 6 0
test12_b4 1/3 R | -1/3 4/3 | 0 4 | 6 0
test12_b4 1/2 R | -1/4 2 | 1 4 | 6 0
test12_b4 1 L | 1 4 | 4 4 | 6 0
test12_b4 1 R | 1 1 | 0 2 | 3 -4
test12_b4 4/3 R | 7/6 13/9 | 1 2/3 | 3 -4
test12_b4 3/2 R | 11/8 3/2 | 3/2 0 | 3 -4
test12_b4 2 L | 5/2 1 | 3 -2 | 3 -4
over_clamped 0 R | 0 0 | 2 4 | 2 -4
over_clamped 1/2 R | 5/4 3/2 | 3 2 | 2 -4
over_clamped 1 L | 3 2 | 4 0 | 2 -4
partially_clamped 0 R | 0 0 | 2 4 | 0 -4
partially_clamped 1/2 R | 1 3/2 | 2 2 | 0 -4
partially_clamped 2 R | 7/2 1 | 1 -2 | 3 4
partially_clamped 5/2 R | 35/8 1/2 | 5/2 0 | 3 4
partially_clamped 3 L | 6 1 | 4 2 | 3 4
shifted_domain 10 R | 0 0 | 4 8 | 0 -16
shifted_domain 41/4 R | 1 3/2 | 4 4 | 0 -16
shifted_domain 21/2 R | 2 2 | 4 0 | 0 -16
shifted_domain 43/4 R | 3 3/2 | 4 -4 | 0 -16
shifted_domain 11 L | 4 0 | 4 -8 | 0 -16
deg0 0 R | 0 0 |  | 
deg0 1 R | 1 3 |  | 
deg0 3/2 R | 1 3 |  | 
deg0 2 R | 4 1 |  | 
deg0 3 L | 4 1 |  | 
deg1 0 R | 0 0 | 1 3 | 0 0
deg1 1/2 R | 1/2 3/2 | 1 3 | 0 0
deg1 3/2 R | 5/2 2 | 3 -2 | 0 0
deg1 2 L | 4 1 | 3 -2 | 0 0
)";

// The same for homogeneous curves and their affine points; r is √2.
const char* const rational_rows = R"(
test13_circle 0 R | -1 0 | 0 1r | 2 -2+2r
test13_circle 1/4 R | -36/41-3/82r -4/41+27/82r | 2352/1681-968/1681r -1488/1681+2808/1681r | 889216/68921-505024/68921r -246400/68921+152640/68921r
test13_circle 1/2 R | -1/2r 1/2r | 4-2r 4-2r | -32+24r 32-24r
test13_circle 3/4 R | 4/41-27/82r 36/41+3/82r | -1488/1681+2808/1681r 2352/1681-968/1681r | 246400/68921-152640/68921r -889216/68921+505024/68921r
test13_circle 1 R | 0 1 | 1r 0 | -2+2r -2
test13_circle 5/4 R | -4/41+27/82r 36/41+3/82r | -1488/1681+2808/1681r -2352/1681+968/1681r | -246400/68921+152640/68921r -889216/68921+505024/68921r
test13_circle 3/2 R | 1/2r 1/2r | 4-2r -4+2r | 32-24r 32-24r
test13_circle 7/4 R | 36/41+3/82r -4/41+27/82r | 2352/1681-968/1681r 1488/1681-2808/1681r | -889216/68921+505024/68921r -246400/68921+152640/68921r
test13_circle 2 R | 1 0 | 0 -1r | -2 2-2r
test13_circle 9/4 R | 36/41+3/82r 4/41-27/82r | -2352/1681+968/1681r 1488/1681-2808/1681r | -889216/68921+505024/68921r 246400/68921-152640/68921r
test13_circle 5/2 R | 1/2r -1/2r | -4+2r -4+2r | 32-24r -32+24r
test13_circle 11/4 R | -4/41+27/82r -36/41-3/82r | 1488/1681-2808/1681r -2352/1681+968/1681r | -246400/68921+152640/68921r 889216/68921-505024/68921r
test13_circle 3 R | 0 -1 | -1r 0 | 2-2r 2
test13_circle 13/4 R | 4/41-27/82r -36/41-3/82r | 1488/1681-2808/1681r 2352/1681-968/1681r | 246400/68921-152640/68921r 889216/68921-505024/68921r
test13_circle 7/2 R | -1/2r -1/2r | -4+2r 4-2r | -32+24r -32+24r
test13_circle 15/4 R | -36/41-3/82r 4/41-27/82r | -2352/1681+968/1681r -1488/1681+2808/1681r | 889216/68921-505024/68921r 246400/68921-152640/68921r
test13_circle 4 L | -1 0 | 0 1r | 2 2-2r
test13_circle 1/3 R | -12/17-2/17r -3/17+8/17r | 828/289-423/289r -252/289+468/289r | 108810/4913-68310/4913r 32022/4913-26028/4913r
test13_circle 2/3 R | 3/17-8/17r 12/17+2/17r | -252/289+468/289r 828/289-423/289r | -32022/4913+26028/4913r -108810/4913+68310/4913r
test13_circle 4/3 R | -3/17+8/17r 12/17+2/17r | -252/289+468/289r -828/289+423/289r | 32022/4913-26028/4913r -108810/4913+68310/4913r
test13_circle 5/3 R | 12/17+2/17r -3/17+8/17r | 828/289-423/289r 252/289-468/289r | -108810/4913+68310/4913r 32022/4913-26028/4913r
test13_circle 7/3 R | 12/17+2/17r 3/17-8/17r | -828/289+423/289r 252/289-468/289r | -108810/4913+68310/4913r -32022/4913+26028/4913r
test13_circle 8/3 R | -3/17+8/17r -12/17-2/17r | 252/289-468/289r -828/289+423/289r | 32022/4913-26028/4913r 108810/4913-68310/4913r
test13_circle 10/3 R | 3/17-8/17r -12/17-2/17r | 252/289-468/289r 828/289-423/289r | -32022/4913+26028/4913r 108810/4913-68310/4913r
test13_circle 11/3 R | -12/17-2/17r 3/17-8/17r | -828/289+423/289r -252/289+468/289r | 108810/4913-68310/4913r -32022/4913+26028/4913r
circle_rational 0 R | 1 0 | 0 2 | -4 0
circle_rational 1/3 R | 4/5 3/5 | -27/25 36/25 | -243/125 -351/125
circle_rational 1/2 R | 3/5 4/5 | -32/25 24/25 | -64/125 -352/125
circle_rational 1 R | 0 1 | -1 0 | -1 -1
circle_rational 3/2 R | -3/5 4/5 | -32/25 -24/25 | 64/125 -352/125
circle_rational 2 R | -1 0 | 0 -2 | 4 0
circle_rational 5/2 R | -3/5 -4/5 | 32/25 -24/25 | 64/125 352/125
circle_rational 3 R | 0 -1 | 1 0 | 1 1
circle_rational 7/2 R | 3/5 -4/5 | 32/25 24/25 | -64/125 352/125
circle_rational 4 L | 1 0 | 0 2 | -4 0
conic_circle_q 0 b | 1 0 | 0 2 | -4 0
conic_circle_q 1/4 b | 15/17 8/17 | -256/289 480/289 | -13312/4913 -12032/4913
conic_circle_q 1/2 b | 3/5 4/5 | -32/25 24/25 | -64/125 -352/125
conic_circle_q 2/3 b | 5/13 12/13 | -216/169 90/169 | 972/2197 -4968/2197
conic_circle_q 1 b | 0 1 | -1 0 | 1 -1
conic_circle_q2 0 b | 1 0 | 0 1r | -2 -2+2r
conic_circle_q2 1/4 b | 36/41+3/82r -4/41+27/82r | -2352/1681+968/1681r -1488/1681+2808/1681r | -889216/68921+505024/68921r -246400/68921+152640/68921r
conic_circle_q2 1/2 b | 1/2r 1/2r | -4+2r 4-2r | 32-24r 32-24r
conic_circle_q2 2/3 b | -3/17+8/17r 12/17+2/17r | 252/289-468/289r 828/289-423/289r | 32022/4913-26028/4913r -108810/4913+68310/4913r
conic_circle_q2 1 b | 0 1 | -1r 0 | -2+2r -2
conic_ellipse 0 b | 3 0 | 0 4 | -12 0
conic_ellipse 1/4 b | 45/17 16/17 | -768/289 960/289 | -39936/4913 -24064/4913
conic_ellipse 1/2 b | 9/5 8/5 | -96/25 48/25 | -192/125 -704/125
conic_ellipse 2/3 b | 15/13 24/13 | -648/169 180/169 | 2916/2197 -9936/2197
conic_ellipse 1 b | 0 2 | -3 0 | 3 -2
conic_hyperbola_std 0 b | 1 0 | 0 1 | 1 0
conic_hyperbola_std 1/4 b | 65/63 16/63 | 1024/3969 4160/3969 | 274432/250047 98816/250047
conic_hyperbola_std 1/2 b | 17/15 8/15 | 128/225 272/225 | 4864/3375 3136/3375
conic_hyperbola_std 2/3 b | 5/4 3/4 | 27/32 45/32 | 243/128 189/128
conic_hyperbola_std 1 b | 5/3 4/3 | 16/9 20/9 | 112/27 104/27
conic_hyperbola_xy 0 b | 2 1/2 | -3 3/4 | 6 3/4
conic_hyperbola_xy 1/4 b | 7/5 5/7 | -48/25 48/49 | 384/125 384/343
conic_hyperbola_xy 1/2 b | 1 1 | -4/3 4/3 | 16/9 16/9
conic_hyperbola_xy 2/3 b | 4/5 5/4 | -27/25 27/16 | 162/125 81/32
conic_hyperbola_xy 1 b | 1/2 2 | -3/4 3 | 3/4 6
conic_neg_weight 0 b | 1 0 | 0 -2 | -4 -8
conic_neg_weight 1/4 b | 3/5 -4/5 | -128/25 -96/25 | -6144/125 1792/125
conic_neg_weight 1/2 b | -1 0 | 0 8 | 64 -32
conic_neg_weight 2/3 b | -3/5 4/5 | 72/25 54/25 | -756/125 -2592/125
conic_neg_weight 1 b | 0 1 | 1 0 | -3 -1
conic_parabola 0 b | -1 1 | 2 -4 | 0 8
conic_parabola 1/4 b | -1/2 1/4 | 2 -2 | 0 8
conic_parabola 1/2 b | 0 0 | 2 0 | 0 8
conic_parabola 2/3 b | 1/3 1/9 | 2 4/3 | 0 8
conic_parabola 1 b | 1 1 | 2 4 | 0 8
conic_zero_weight 0 b | 1 0 | 0 2 | -4 4
conic_zero_weight 1/4 b | 4/5 3/5 | -48/25 64/25 | -1408/125 -256/125
conic_zero_weight 1/2 b | 0 1 | -4 0 | 0 -16
conic_zero_weight 2/3 b | -3/5 4/5 | -72/25 -54/25 | 1404/125 -972/125
conic_zero_weight 1 b | -1 0 | 0 -2 | 4 4
conic_pole 0 b | 0 0 | -2 -2 | -8 -12
conic_pole 1/4 b | -1 -3/2 | -8 -16 | -64 -192
conic_pole 1 b | 2 0 | -2 2 | 8 -12
)";

// "a+br" with fractions a and b.
Quadratic root_two_number(const std::string& text) {
  if (text.back() != 'r') return in_root_two(text);
  const std::string digits = text.substr(0, text.size() - 1);
  const std::size_t sign = digits.find_last_of("+-");
  if (sign == std::string::npos || sign == 0) return in_root_two("0", digits);
  return in_root_two(digits.substr(0, sign), digits.substr(digits[sign] == '+' ? sign + 1 : sign));
}

struct Row {
  std::string name;
  Rational t;
  std::vector<Side> sides;
  std::vector<Vec<Quadratic, 2>> values;  // as many orders as are given
};

std::vector<Row> rows_of(const char* text) {
  std::vector<Row> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    std::istringstream words(line);
    Row row;
    std::string t, side, bar, x, y;
    words >> row.name >> t >> side;
    row.t = Rational(t);
    if (side != "L") row.sides.push_back(Side::right);
    if (side != "R") row.sides.push_back(Side::left);
    while (words >> bar && words >> x && words >> y) row.values.push_back({{root_two_number(x), root_two_number(y)}});
    rows.push_back(row);
  }
  return rows;
}

TEST(ReferenceValues, PolynomialCurves) {
  const std::vector<Row> rows = rows_of(polynomial_rows);
  EXPECT_EQ(rows.size(), 181u);
  for (const Row& row : rows)
    for (const Side side : row.sides) {
      SCOPED_TRACE(row.name);
      const auto d = derivatives(lar_curve(row.name), row.t, static_cast<int>(row.values.size()) - 1, side);
      for (std::size_t k = 0; k < d.size(); ++k)
        for (int c : {0, 1})
          EXPECT_TRUE(Quadratic(d[k][c]) == row.values[k][c]) << "t = " << row.t << ", derivative " << k;
    }
}

BsplineCurve<Quadratic, 3> rational_curve(const std::string& name) {
  const auto arc = [](const std::string& text) {
    std::istringstream in(text);
    ConicArc<Quadratic, 3> out;
    for (auto& point : out)
      for (auto& x : point.c) {
        std::string word;
        in >> word;
        x = root_two_number(word);
      }
    return to_curve(out);
  };
  if (name == "test13_circle") return lar_circle();
  if (name == "circle_rational") return unit_circle<Quadratic>();
  if (name == "conic_circle_q2") return arc("1 0 1  1/2r 1/2r 1/2r  0 1 1");
  if (name == "conic_circle_q") return arc("1 0 1  1 1 1  0 2 2");
  if (name == "conic_ellipse") return arc("3 0 1  3 2 1  0 4 2");
  if (name == "conic_parabola") return arc("-1 1 1  0 -1 1  1 1 1");
  if (name == "conic_hyperbola_xy") return arc("2 1/2 1  1 1 5/4  1/2 2 1");
  if (name == "conic_hyperbola_std") return arc("1 0 1  1 1/2 1  5/4 1 3/4");
  if (name == "conic_neg_weight") return arc("1 0 1  -1 -1 -1  0 2 2");
  if (name == "conic_zero_weight") return arc("1 0 1  0 1 0  -1 0 1");
  if (name == "conic_pole") return arc("0 0 1  -1 -1 -1  2 0 1");
  throw std::invalid_argument("no curve " + name);
}

TEST(ReferenceValues, RationalCurves) {
  const std::vector<Row> rows = rows_of(rational_rows);
  EXPECT_EQ(rows.size(), 78u);
  for (const Row& row : rows)
    for (const Side side : row.sides) {
      SCOPED_TRACE(row.name);
      const auto d = rational_derivatives(rational_curve(row.name), Quadratic(row.t), 2, side);
      ASSERT_EQ(row.values.size(), 3u);
      for (int k : {0, 1, 2}) EXPECT_TRUE(d[k] == row.values[k]) << "t = " << row.t << ", derivative " << k;
    }
}

TEST(ReferenceValues, BasisFunctions) {
  const auto circle = KnotVector<Rational>::make(2, circle_knots()).value();
  const auto uniform = lar_curve("test11b").knots();
  const auto basis = [](const KnotVector<Rational>& k, const char* t, Side side = Side::right) {
    return basis_derivative(k, Rational(t), 0, side);
  };
  EXPECT_EQ(basis(circle, "0"), numbers_of("1 0 0 0 0 0 0 0 0"));
  EXPECT_EQ(basis(circle, "1/2"), numbers_of("1/4 1/2 1/4 0 0 0 0 0 0"));
  EXPECT_EQ(basis(circle, "5/4"), numbers_of("0 0 9/16 3/8 1/16 0 0 0 0"));
  EXPECT_EQ(basis(circle, "7/3"), numbers_of("0 0 0 0 4/9 4/9 1/9 0 0"));
  EXPECT_EQ(basis(circle, "15/4"), numbers_of("0 0 0 0 0 0 1/16 3/8 9/16"));
  EXPECT_EQ(basis(circle, "4", Side::left), numbers_of("0 0 0 0 0 0 0 0 1"));
  for (const char* t : {"1", "2", "3"})
    for (const Side side : {Side::left, Side::right}) EXPECT_EQ(basis(circle, t, side)[2 * std::stoi(t)], 1);
  EXPECT_EQ(basis(uniform, "2"), numbers_of("1/2 1/2 0 0 0"));
  EXPECT_EQ(basis(uniform, "5/2"), numbers_of("1/8 3/4 1/8 0 0"));
  EXPECT_EQ(basis(uniform, "3"), numbers_of("0 1/2 1/2 0 0"));
  EXPECT_EQ(basis(uniform, "5", Side::left), numbers_of("0 0 0 1/2 1/2"));
}

TEST(ReferenceValues, ParametersOutsideTheDomain) {
  for (const auto& [name, t] : {std::pair{"test11b", "1/2"},
                                {"test11b", "13/2"},
                                {"test12_b2", "9/2"},
                                {"test12_b3", "4"},
                                {"shifted_domain", "1/2"},
                                {"test08a", "-1/10"},
                                {"test08a", "71/10"}})
    EXPECT_THROW(evaluate(lar_curve(name), Rational(t)), contract_error) << name << " at " << t;
}

}  // namespace
}  // namespace patchproof::test
