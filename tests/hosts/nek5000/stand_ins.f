c     SPDX-License-Identifier: Apache-2.0
c     Stands for the routines of Nek5000 that the user files call. There
c     is one rank, and the elements are boxes along the axes.
c-----------------------------------------------------------------------
      subroutine mpi_abort(icomm,icode,ierr)
      write(6,*) 'mpi_abort'
      stop 3
      end
      subroutine rzero(a,n)
      real a(n)
      call cfill(a,0.,n)
      end
      subroutine cfill(a,b,n)
      real a(n)
      a = b
      end
      subroutine col3(a,b,c,n)
      real a(n),b(n),c(n)
      a = b*c
      end
      subroutine add2(a,b,n)
      real a(n),b(n)
      a = a+b
      end
      real function glsc2(a,b,n)
      real a(n),b(n)
      glsc2 = sum(a*b)
      end
      real function glsum(a,n)
      real a(n)
      glsum = sum(a)
      end
      real function glmax(a,n)
      real a(n)
      glmax = maxval(a)
      end
      real function glamax(a,n)
      real a(n)
      glamax = maxval(abs(a))
      end
      integer function iglsum(i,n)
      integer i(n)
      iglsum = sum(i)
      end
      real function dnekclock()
      call cpu_time(dnekclock)
      end
      subroutine full_restart_save(i)
      end
      subroutine full_restart(names,n)
      character*(*) names(n)
      end
      subroutine facind(k0,k1,j0,j1,i0,i1,nx,ny,nz,ifc)
c     The faces 5 and 6 are the ends of an element along z.
      k0 = 1
      k1 = nx
      j0 = 1
      j1 = ny
      i0 = 1+(ifc-5)*(nz-1)
      i1 = i0
      end
c-----------------------------------------------------------------------
      subroutine gradm1(gx,gy,gz,u)
c     Gives the gradient of the polynomials of the elements.
      include 'SIZE'
      include 'TOTAL'
      real gx(lx1,lx1,lx1,lelt),gy(lx1,lx1,lx1,lelt)
     $ ,gz(lx1,lx1,lx1,lelt),u(lx1,lx1,lx1,lelt)
      real dx(lx1,lx1),dy(lx1,lx1),dz(lx1,lx1)
      integer e
      do e=1,nelv
         call slopes(xm1(1:lx1,1,1,e),dx)
         call slopes(ym1(1,1:lx1,1,e),dy)
         call slopes(zm1(1,1,1:lx1,e),dz)
         do k=1,lx1
         do j=1,lx1
         do i=1,lx1
            gx(i,j,k,e) = sum(dx(i,:)*u(:,j,k,e))
            gy(i,j,k,e) = sum(dy(j,:)*u(i,:,k,e))
            gz(i,j,k,e) = sum(dz(k,:)*u(i,j,:,e))
         enddo
         enddo
         enddo
      enddo
      end
      subroutine slopes(x,d)
c     d(i,j) is the slope at x(i) of the polynomial that is 1 at x(j)
c     and 0 at the other points.
      include 'SIZE'
      real x(lx1),d(lx1,lx1)
      do j=1,lx1
      do i=1,lx1
         d(i,j) = 0.
         do m=1,lx1
            if (m.eq.j) cycle
            p = 1./(x(j)-x(m))
            do l=1,lx1
               if (l.ne.j.and.l.ne.m) p = p*(x(i)-x(l))/(x(j)-x(l))
            enddo
            d(i,j) = d(i,j)+p
         enddo
      enddo
      enddo
      end
c-----------------------------------------------------------------------
      subroutine boxes(nx,ny,nz,x0,x1,y0,y1,z0,z1)
c     Makes nx x ny x nz elements, and sets the variables that Nek sets
c     before userchk.
      include 'SIZE'
      include 'TOTAL'
      real g(5)
      integer e
      data g /0.,.17267316464601146,.5,.82732683535398854,1./
      e = 0
      do kz=1,nz
      do ky=1,ny
      do kx=1,nx
         e = e+1
         lglel(e) = e
         gllel(e) = e
         do k=1,lx1
         do j=1,lx1
         do i=1,lx1
            xm1(i,j,k,e) = x0+(x1-x0)*(kx-1+g(i))/nx
            ym1(i,j,k,e) = y0+(y1-y0)*(ky-1+g(j))/ny
            zm1(i,j,k,e) = z0+(z1-z0)*(kz-1+g(k))/nz
         enddo
         enddo
         enddo
      enddo
      enddo
      enddo
      nid = 0
      nelv = e
      n = lx1**3*nelv
      pi = acos(-1.)
      cpfld = 0.
      cpfld(1,1) = .04
      cpfld(1,2) = 1.06
      cpfld(2,1) = .5
      cpfld(2,2) = 2.
      bd = 0.
      bd(1) = 1.5
      dt = 1e-3
      time = 0.
      istep = 0
      nsteps = 1000
      ifield = 1
      boundaryID = 0
      iflomach = .false.
      ifmvbd = .false.
      ifuservp = .false.
      call cfill(bm1,.001,n)
      call rzero(vx,n)
      call rzero(vy,n)
      call rzero(vz,n)
      call rzero(pr,n)
      call cfill(v1mask,1.,n)
      call cfill(v2mask,1.,n)
      call cfill(v3mask,1.,n)
      end
