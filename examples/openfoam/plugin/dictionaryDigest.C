// SPDX-License-Identifier: Apache-2.0
// The digest of a dictionary, for LD_PRELOAD. OpenFOAM asks for it before the first step of every function object. The 1912 of
// Debian 13 ends there with 'error in IOstream "sha1"', a known fault of builds by gcc 12 and later. This digest goes through a
// string and not through OpenFOAM's stream of digests. OpenFOAM compares digests only with others of the same run.
#include "OStringStream.H"
#include "SHA1.H"
#include "SHA1Digest.H"
#include "dictionary.H"

Foam::SHA1Digest Foam::dictionary::digest() const {
  OStringStream text;
  for (const entry &one : *this) text << one;
  return SHA1(text.str()).digest();
}
