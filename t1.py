import sys;sys.path.insert(0,'/tmp/h5/w')
from ms import *
import subprocess
D='/work/shared/data/'
for name,src in [('sheets','/tmp/h5/w/sheets.obj'),('spot',D+'scans/spot.obj'),('dress',D+'garments/dress_14_pieces_uv.obj')]:
    V,F,VT,FT=rd(src)
    for mv in (False,True):
        lg=f'/tmp/h5/w/{name}_{mv}.log'
        L=CollapseLog(lg,src,len(V),len(F))
        W,G,ops,dg=collapse(V,F,len(F)//2,L,mv)
        L.close(len(G),dg)
        W,G=compact(W,G)
        wr(f'/tmp/h5/w/{name}_{mv}.obj',W,G); wrply(f'/tmp/h5/w/{name}_{mv}.ply',W,G);wrply(f'/tmp/h5/w/{name}_{mv}_f.ply',W,G,'float')
        wrglb(f'/tmp/h5/w/{name}_{mv}.glb',[(W,G,None)])
        for a in ([],['--all']):
            r=subprocess.run(['/tmp/h5/selvedge','replay',src,lg,'--no-limits','-o',f'/tmp/h5/w/{name}_{mv}_re.obj']+a,capture_output=True,text=True)
            print(name,mv,a,len(ops),len(G),'rc',r.returncode,r.stderr[:300]);print('\n'.join([l for l in r.stdout.split('\n') if not l.startswith(('not judged','v ','f ','o ','l '))][:3]+r.stdout.split('\n')[-4:]))
        if True:
            A,B,_,_=rd(f'/tmp/h5/w/{name}_{mv}_re.obj')
            used=np.unique(B);print('replayed equals mine:',len(B)==len(G) and (A[B]==W[G]).all(), len(A),len(W))
        for e in ('.obj','.ply','_f.ply','.glb'):
            r=subprocess.run(['/tmp/h5/selvedge','verify',f'/tmp/h5/w/{name}_{mv}{e}','--against',src],capture_output=True,text=True)
            print(e,r.returncode,r.stderr);print(r.stdout[:900] if e=='.obj' else '\n'.join(r.stdout.split('\n')[:2]))
