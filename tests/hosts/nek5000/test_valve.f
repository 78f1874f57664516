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
      call ensure_ends(-1.,1.,600.,-1.)
      call ensure_ends(1.,1.,0.,0.)
      call ensure_ends(1.,-1.,600.,0.)
      call ensure_drive
      write(6,*) 'valve: fine'
      end
c-----------------------------------------------------------------------
      subroutine ensure_ends(flow,point,most,to)
c     The outlet has the mean velocity flow, and the velocity point at
c     each of its points. K must be most at the outlet's end, and must
c     slow the blood to the velocity to. At the inlet, where blood has
c     the mean velocity 3, K must be 600.
      include 'SIZE'
      include 'TOTAL'
      include 'NEKUSE'
      include 'RIISV'
      integer e
      real most
      common /ends/ uin,uout,across,pnext
      istep = 1
      uparam(15) = 600.
      uin = 3.
      uout = flow
      rk = 0.
      rkz = 0.
      call cfill(vz,point,lx1*ly1*lz1*nelv)
      do e=1,nelv
      do iz=1,lz1
         call rzero(bfz,lx1*ly1*lz1*nelv)
         call uservp(2,3,iz,e)
         zz = zm1(2,3,iz,e)
         a = 600.*max(.9-zz,0.)**2/.36
         b = a*3.
         if (zz.gt.1.7) a = most*(zz-1.7)**2/.36
         if (zz.gt.1.7) b = a*to
         call close(utrans-1.06,a*dt/1.5,'K of the ends')
         call close(bfz(2,3,iz,e),b*.001,'its velocity')
      enddo
      enddo
      end
c-----------------------------------------------------------------------
      subroutine ensure_drive
c     In a pipe of the area 2, the pressure drives blood without a
c     loss. The blood must have the flow of the wave, and must rest
c     while the leaflets move.
      include 'SIZE'
      include 'TOTAL'
      real mean
      common /ends/ uin,uout,across,pnext
      uparam(7) = 90.
      across = 2.
      mean = 0.
      total = 0.
      do i=0,699
         call valve_drive(i*dt,mean,p)
         mean = mean+p*dt/(1.06*(uparam(14)-uparam(11)))
         call valve_opening((i+1)*dt,o)
         if (o.lt..9) call ensure(abs(mean).lt..2,'leaflets and blood')
         if (i.eq.309) call ensure(abs(mean-45.).lt..5,'the peak')
         total = total+2.*mean*dt
      enddo
      call ensure(abs(total-90.*.13).lt..1,'the volume of the beat')
c     The drive must slow blood that is too fast.
      call valve_drive(.31,0.,p)
      call valve_drive(.31,1.,q)
      call close(p-q,1.06*(uparam(14)-uparam(11))/.02,'the drive')
      call valve_drive(.75,mean,p)
      call close(p,-uparam(4),'the pressure on the closed valve')
      uparam(3) = .5
      call valve_drive(.3,mean,p)
      call close(p,uparam(4),'the pressure on a held valve')
      end
