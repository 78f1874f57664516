c     SPDX-License-Identifier: Apache-2.0
c     Runs plate.usr with an upright and with a leaning plate. With the
c     words Pn-Pn-2, lowMach or moves, riis_served must stop.
      program test_plate
      include 'SIZE'
      include 'TOTAL'
      character*16 word
      call boxes(4,4,6,-.5,.5,-.5,.5,-.75,.75)
      call get_command_argument(1,word)
      iflomach = word.eq.'lowMach'
      ifmvbd = word.eq.'moves'
      call usrdat2
      if (word.ne.' ') stop 0
      call ensure(ifuservp,'ifuservp')
      uparam(1) = 1e5
      uparam(2) = .145
      uparam(3) = 2000.
      uparam(4) = .013
      do lean=0,20,20
         uparam(5) = lean
         istep = 0
         call userchk
         call ensure(nmxp.eq.2000,'the cap')
         call ensure_marks(1000)
         call ensure_implicit
      enddo
      istep = 1
      call userchk
      call ensure_marks(1000)
      write(6,*) 'plate: fine'
      end
