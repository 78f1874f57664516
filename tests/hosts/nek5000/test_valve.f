c     SPDX-License-Identifier: Apache-2.0
c     Runs valve.usr: held openings, steps of the beat, and the source
c     in the band where its value is known.
      program test_valve
      include 'SIZE'
      include 'TOTAL'
      include 'RIISV'
      real held(3),net
      data held /0.,.02,.6/
      call boxes(4,4,3,-1.25,1.25,-1.25,1.25,.3,2.3)
      call usrdat2
      uparam(1) = 1e4
      uparam(2) = .2
      uparam(4) = 1e4
      uparam(6) = 1.
      uparam(10) = -1.
      uparam(11) = .3
      uparam(12) = .9
      uparam(13) = 1.7
      uparam(14) = 2.3
      do i=1,3
         istep = 0
         uparam(3) = held(i)
         call userchk
         call ensure_marks(300)
         call ensure(maxval(abs(rkz)).eq.0.,'a held valve moves')
         call ensure(maxval(abs(usrdiv)).eq.0.,'source of a held valve')
      enddo
      istep = 0
      uparam(3) = -1.
      call userchk
      do i=1,3
         time = .04+.02*i
         istep = i
         call userchk
         call ensure_marks(300)
         call ensure(maxval(abs(rkz)).gt.0.,'the valve rests')
         call ensure(maxval(abs(usrdiv)).gt.0.,'no source')
      enddo
      call ensure_implicit
c     A surface that moves as a whole has no source, for any K.
      do i=1,lx1*ly1*lz1*nelv
         rkx(i,1,1,1) = 3.*rk(i,1,1,1)
         rky(i,1,1,1) = -2.*rk(i,1,1,1)
         rkz(i,1,1,1) = rk(i,1,1,1)
      enddo
      call riis_source(net)
      call ensure(maxval(abs(usrdiv)).lt.1e-9,'a source of a shift')
c     The source of a surface that stretches is th div v. Here v is
c     (2x, 5y, 0), and th = K dt/1.5 / (rho + K dt/1.5) is 2/3.
      rk = 3180.
      do i=1,lx1*ly1*lz1*nelv
         rkx(i,1,1,1) = 2.*xm1(i,1,1,1)*rk(i,1,1,1)
         rky(i,1,1,1) = 5.*ym1(i,1,1,1)*rk(i,1,1,1)
         rkz(i,1,1,1) = 0.
      enddo
      call riis_source(net)
      do i=1,lx1*ly1*lz1*nelv
         call close(usrdiv(i,1,1,1),7.*2./3.,'the source')
      enddo
      call close(net,7.*2./3.*.001*lx1**3*nelv,'its integral')
      write(6,*) 'valve: fine'
      end
