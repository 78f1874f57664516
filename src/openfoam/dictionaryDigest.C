// SPDX-License-Identifier: Apache-2.0
// Replaces OpenFOAM's digest of a dictionary, if LD_PRELOAD loads this library. OpenFOAM computes the digest before the first
// step of every function object. OpenFOAM 1912 of Debian 13 stops there with 'error in IOstream "sha1"', a known fault of builds
// by gcc 12 and later. The function here computes the digest of a string without OpenFOAM's stream of digests. Its digests need
// not be those of OpenFOAM, because OpenFOAM compares only digests of the same run.
#include "OStringStream.H"
#include "SHA1.H"
#include "SHA1Digest.H"
#include "dictionary.H"

Foam::SHA1Digest Foam::dictionary::digest() const {
  OStringStream text;
  for (const entry &one : *this) text << one;
  return SHA1(text.str()).digest();
}
