c     SPDX-License-Identifier: Apache-2.0
c     Checks of the user files of examples/nek5000, which run against
c     stand-ins for Nek5000.
c-----------------------------------------------------------------------
      subroutine ensure(holds,text)
      logical holds
      character*(*) text
      if (holds) return
      write(6,*) 'failed: ',text
      stop 1
      end
c-----------------------------------------------------------------------
      subroutine ensure_marks(least)
c     At every point, K must equal the K of a loop over all triangles.
c     At least the given number of points must be marked.
      include 'SIZE'
      include 'TOTAL'
      include 'RIISV'
      parameter (lt=lx1*ly1*lz1*lelt)
      real d(lt)
      n = lx1*ly1*lz1*nelv
      r = uparam(1)
      eps = uparam(2)
      call brute_distances(jsurf,n,xm1,ym1,zm1,1,2.*eps,d)
      marked = 0
      do i=1,n
         expect = 0.
         if (d(i).lt.eps) expect = r/eps**2*(1.+cos(pi*d(i)/eps))/2.
         if (rk(i,1,1,1).gt.0.) marked = marked+1
         call ensure((expect.gt.0.).eqv.(rk(i,1,1,1).gt.0.),'marks')
         call ensure(abs(expect-rk(i,1,1,1)).le.1e-12*r/eps**2,'K')
      enddo
      call ensure(marked.ge.least,'points are marked')
      end
c-----------------------------------------------------------------------
      subroutine ensure_implicit
c     After step 0, uservp must add K dt/bd(1) to rho, and K u_surface
c     to the right-hand side of the velocity. userchk must leave vtrans
c     equal to rho.
      include 'SIZE'
      include 'TOTAL'
      include 'NEKUSE'
      include 'RIISV'
      integer e
      n = lx1*ly1*lz1*nelv
      do i=1,n
         call ensure(vtrans(i,1,1,1,1).eq.cpfld(1,2),'vtrans')
      enddo
      do itry=1,3
         istep = min(itry-1,1)
         ifield = 1+itry/3
         rho = cpfld(ifield,2)
         factor = 0.
         if (itry.eq.2) factor = 1.
         call rzero(bfx,n)
         call rzero(bfy,n)
         call rzero(bfz,n)
         do e=1,nelv
         do iz=1,lz1
         do iy=1,ly1
         do ix=1,lx1
            call uservp(ix,iy,iz,e)
            call ensure(udiff.eq.cpfld(ifield,1),'udiff')
            call close(utrans-rho,factor*rk(ix,iy,iz,e)*dt/1.5,'utrans')
            f = factor*bm1(ix,iy,iz,e)
            call close(bfx(ix,iy,iz,e),f*rkx(ix,iy,iz,e),'bfx')
            call close(bfy(ix,iy,iz,e),f*rky(ix,iy,iz,e),'bfy')
            call close(bfz(ix,iy,iz,e),f*rkz(ix,iy,iz,e),'bfz')
         enddo
         enddo
         enddo
         enddo
      enddo
      ifield = 1
      end
      subroutine close(a,b,text)
      character*(*) text
      call ensure(abs(a-b).le.1e-12*(1.+abs(b)),text)
      end
