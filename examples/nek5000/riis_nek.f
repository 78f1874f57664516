c     SPDX-License-Identifier: Apache-2.0
c     riis in Nek5000: the part that all cases share. A .usr file
c     includes this file, and calls
c        riis_served    in usrdat2
c        riis_reset     in userchk, before its marks for the next step
c        riis_source    in userchk, after the marks, if the valve moves
c        riis_implicit  in uservp
c-----------------------------------------------------------------------
      subroutine riis_check(istat,where)
c     Stops all ranks with the message of riis if a call failed.
      include 'SIZE'
      include 'riisf.h'
      integer istat
      character*(*) where
      character*512 text
      if (istat.eq.RIIS_OK) return
      call riisf_last_error(text)
      write(6,*) 'riis: rank',nid,', ',where,': ',trim(text)
      call riis_stop
      end
c-----------------------------------------------------------------------
      subroutine riis_stop
c     exitt waits for all ranks, and an error may be on one rank only.
      include 'mpif.h'
      call flush(6)
      call mpi_abort(MPI_COMM_WORLD,1,ierr)
      end
c-----------------------------------------------------------------------
      subroutine riis_served
c     Switches uservp on, and stops if this scheme would falsify K.
      include 'SIZE'
      include 'TOTAL'
      if (lx2.ne.lx1) then
         if (nid.eq.0) write(6,*) 'riis: lx2 =',lx2,' in SIZE, but ',
     $   'K in utrans needs Pn-Pn: set lx2=lx1. Pn-Pn-2 sets utrans ',
     $   'before it makes the right side.'
         call riis_stop
      endif
      if (iflomach) then
         if (nid.eq.0) write(6,*) 'riis: lowMach multiplies the right ',
     $   'side by utrans, so K cannot stand there: take incompNS.'
         call riis_stop
      endif
      if (ifmvbd) then
         if (nid.eq.0) write(6,*) 'riis: the mesh moves, but these ',
     $   'files do not call riisf_mesh_update.'
         call riis_stop
      endif
      ifuservp = .true.
      end
c-----------------------------------------------------------------------
      subroutine riis_reset
c     Sets vtrans to rho. Nek makes the right-hand side of the next step
c     with this vtrans, and calls uservp afterwards.
      include 'SIZE'
      include 'TOTAL'
      call cfill(vtrans,cpfld(1,2),lx1*ly1*lz1*nelv)
      end
c-----------------------------------------------------------------------
      subroutine riis_implicit(ix,iy,iz,e,ut)
c     Makes K implicit at one point. ut = rho + K dt/bd(1) divides in
c     the pressure equation, and stands in the velocity equation beside
c     bd(1)/dt. K u_surface joins the right-hand side, which Nek has
c     made. At walls the masks are 0, so nothing joins: there the fluid
c     rests.
      include 'SIZE'
      include 'TOTAL'
      include 'RIISV'
      integer e
      real ut
      if (ifield.ne.1 .or. istep.eq.0) return
      ut = ut + rk(ix,iy,iz,e)*dt/bd(1)
      b = bm1(ix,iy,iz,e)
      bfx(ix,iy,iz,e) = bfx(ix,iy,iz,e) + rkx(ix,iy,iz,e)*b
     $   *v1mask(ix,iy,iz,e)
      bfy(ix,iy,iz,e) = bfy(ix,iy,iz,e) + rky(ix,iy,iz,e)*b
     $   *v2mask(ix,iy,iz,e)
      bfz(ix,iy,iz,e) = bfz(ix,iy,iz,e) + rkz(ix,iy,iz,e)*b
     $   *v3mask(ix,iy,iz,e)
      end
c-----------------------------------------------------------------------
      subroutine riis_source(net)
c     The source in the band, usrdiv, for the step that comes next, and
c     its integral. In the band the fluid has the share th of the
c     surface's velocity v. The source is th times the divergence of v,
c     computed as div(th v) - v.grad(th). So no derivative of v crosses
c     the edge of the band, where v ends. At walls v is 0.
      include 'SIZE'
      include 'TOTAL'
      include 'RIISV'
      parameter (lt=lx1*ly1*lz1*lelt)
      common /riiss/ th(lt),vs(lt,3),w(lt),g(lt,3)
      real net
      n = lx1*ly1*lz1*nelv
c     bd(1) of the second and later steps
      bd1 = 1.5
      do i=1,n
         a = rk(i,1,1,1)*dt/bd1
         th(i) = a/(cpfld(1,2)+a)
         do k=1,3
            vs(i,k) = 0.
         enddo
         if (rk(i,1,1,1).gt.0.) then
            vs(i,1) = v1mask(i,1,1,1)*rkx(i,1,1,1)/rk(i,1,1,1)
            vs(i,2) = v2mask(i,1,1,1)*rky(i,1,1,1)/rk(i,1,1,1)
            vs(i,3) = v3mask(i,1,1,1)*rkz(i,1,1,1)/rk(i,1,1,1)
         endif
      enddo
      call rzero(usrdiv,n)
      call gradm1(g(1,1),g(1,2),g(1,3),th)
      do k=1,3
         do i=1,n
            usrdiv(i,1,1,1) = usrdiv(i,1,1,1) - vs(i,k)*g(i,k)
         enddo
      enddo
      do k=1,3
         call col3(w,th,vs(1,k),n)
         call gradm1(g(1,1),g(1,2),g(1,3),w)
         call add2(usrdiv,g(1,k),n)
      enddo
      do i=1,n
         if (rk(i,1,1,1).le.0.) usrdiv(i,1,1,1) = 0.
      enddo
      net = glsc2(usrdiv,bm1,n)
      end
c-----------------------------------------------------------------------
      subroutine riis_brute(r,eps)
c     Compares K with K from a loop over all points and triangles.
      include 'SIZE'
      include 'TOTAL'
      include 'RIISV'
      include 'riisf.h'
      parameter (most=20000)
      common /riist/ corner(3,most),ntri(3,most),nleaf(most)
     $ ,npatch(most),idtri(most)
      integer*8 idtri
      integer istat
      call riisf_surface_vertices(jsurf,most,nv,corner,istat)
      call riis_check(istat,'vertices')
      call riisf_surface_triangles(jsurf,most,nt,ntri,idtri,nleaf
     $   ,npatch,istat)
      call riis_check(istat,'triangles')
      nb = 0
      nd = 0
      dk = 0.
      do i=1,lx1*ly1*lz1*nelv
         dsq = 1e30
         do j=1,nt
            dsq = min(dsq,ptri2(xm1(i,1,1,1),ym1(i,1,1,1),zm1(i,1,1,1)
     $         ,corner(1,ntri(1,j)),corner(1,ntri(2,j))
     $         ,corner(1,ntri(3,j))))
         enddo
         dis = sqrt(dsq)
         rkb = 0.
         if (dis.lt.eps) rkb = r/eps*(1.+cos(pi*dis/eps))/(2.*eps)
         if (rkb.gt.0.) nb = nb+1
         if ((rkb.gt.0.).neqv.(rk(i,1,1,1).gt.0.)) nd = nd+1
         dk = max(dk,abs(rkb-rk(i,1,1,1)))
      enddo
      nb = iglsum(nb,1)
      nd = iglsum(nd,1)
      dk = glmax(dk,1)
      if (nid.eq.0) write(6,9) istep,nt,nb,nd,dk*eps*eps/r
    9 format('RIIS_BRUTE step',i6,' triangles',i7,' marked',i8,
     $   ' differ',i4,' max dK/Kmax',1pe9.2)
      end
c-----------------------------------------------------------------------
      function ptri2(x,y,z,a,b,c)
c     The squared distance of a point to a triangle
      real a(3),b(3),c(3),p(3),ab(3),ac(3),ap(3)
      p(1) = x
      p(2) = y
      p(3) = z
      do i=1,3
         ab(i) = b(i)-a(i)
         ac(i) = c(i)-a(i)
         ap(i) = p(i)-a(i)
      enddo
      aa = dot3(ab,ab)
      bb = dot3(ab,ac)
      cc = dot3(ac,ac)
      d1 = dot3(ab,ap)
      d2 = dot3(ac,ap)
      det = aa*cc-bb*bb
      s = cc*d1-bb*d2
      t = aa*d2-bb*d1
      if (s.ge.0. .and. t.ge.0. .and. s+t.le.det .and. det.gt.0.) then
         s = s/det
         t = t/det
         ptri2 = 0.
         do i=1,3
            ptri2 = ptri2 + (ap(i)-s*ab(i)-t*ac(i))**2
         enddo
      else
         ptri2 = min(pseg2(p,a,b),pseg2(p,b,c),pseg2(p,a,c))
      endif
      end
      function pseg2(p,a,b)
c     The squared distance of a point to a segment
      real p(3),a(3),b(3),ab(3),ap(3)
      do i=1,3
         ab(i) = b(i)-a(i)
         ap(i) = p(i)-a(i)
      enddo
      t = max(0.,min(1.,dot3(ab,ap)/dot3(ab,ab)))
      pseg2 = 0.
      do i=1,3
         pseg2 = pseg2 + (ap(i)-t*ab(i))**2
      enddo
      end
      function dot3(a,b)
      real a(3),b(3)
      dot3 = a(1)*b(1)+a(2)*b(2)+a(3)*b(3)
      end
c-----------------------------------------------------------------------
      subroutine riis_dump(kstep)
c     Writes global point number, place, K and velocity of every point
c     to points.RANK at step kstep. A comparison of runs reads them.
      include 'SIZE'
      include 'TOTAL'
      include 'RIISV'
      character*16 name
      integer e
      if (istep.ne.kstep) return
      write(name,'(a,i3.3)') 'points.',nid
      open(unit=77,file=name,status='replace')
      nxyz = lx1*ly1*lz1
      do e=1,nelv
      do i=1,nxyz
         write(77,'(i10,1p7e25.16)') (lglel(e)-1)*nxyz+i
     $      ,xm1(i,1,1,e),ym1(i,1,1,e),zm1(i,1,1,e),rk(i,1,1,e)
     $      ,vx(i,1,1,e),vy(i,1,1,e),vz(i,1,1,e)
      enddo
      enddo
      close(77)
      end
