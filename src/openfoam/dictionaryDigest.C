// SPDX-License-Identifier: Apache-2.0
// If LD_PRELOAD loads this library, it replaces the function by which OpenFOAM computes the digest of a dictionary. OpenFOAM
// computes the digest of a dictionary before the first step of every function object. In OpenFOAM 1912 of Debian 13, the
// computation stops with 'error in IOstream "sha1"', a known fault of builds by gcc 12 and later. This library computes the
// digest of a string without OpenFOAM's stream of digests. The digests may differ from OpenFOAM's, because OpenFOAM compares only
// digests of one run.
#include "OStringStream.H"
#include "SHA1.H"
#include "SHA1Digest.H"
#include "dictionary.H"

Foam::SHA1Digest Foam::dictionary::digest() const {
  OStringStream text;
  for (const entry &one : *this) text << one;
  return SHA1(text.str()).digest();
}
